#include "data/raster_place.h"

#include <algorithm>
#include <cmath>

namespace data {

namespace {

constexpr double kLatitudeSlack = 1e-6;  // degrees; a pole that rounding has moved

lod::Result<RasterAffine> affine_from(const std::array<double, 6>& g) {
    const double determinant = g[1] * g[5] - g[2] * g[4];
    bool is_usable = std::isfinite(determinant) && determinant != 0.0;
    for (double value : g)
        is_usable = is_usable && std::isfinite(value);
    if (!is_usable)
        return lod::Error{"geotransform is not invertible; expected six finite numbers, an area > 0"};
    RasterAffine affine;
    affine.crs_from_cells = glm::dmat2(g[1], g[4], g[2], g[5]);
    affine.cells_from_crs = glm::inverse(affine.crs_from_cells);
    affine.origin = glm::dvec2(g[0], g[3]) + affine.crs_from_cells * glm::dvec2(0.5);
    return affine;
}

}  // namespace

RasterPlace::RasterPlace(const RasterAffine& affine, GeodeticTransform transform)
    : affine_(affine), transform_(std::move(transform)) {}

lod::Result<RasterPlace> RasterPlace::make(const std::array<double, 6>& geo_transform, const std::string& crs,
                                           int width, int height) {
    const auto affine = affine_from(geo_transform);
    if (!affine) return affine.error();
    auto transform = GeodeticTransform::make(crs);
    if (!transform) return transform.error();
    RasterPlace place(*affine, std::move(*transform));
    place.middle_x_ = affine->crs_from_grid(glm::dvec2(width - 1, height - 1) * 0.5).x;
    place.is_site_crs_ = !place.has_datum() || place.is_wgs84_degrees(width, height);
    return place;
}

// Asked of PROJ itself at points inside the raster: datums and units have many names for the same.
bool RasterPlace::is_wgs84_degrees(int width, int height) const {
    constexpr int kProbes = 5;
    if (transform_.kind() != CrsKind::kGeographic) return false;
    for (int k = 0; k < kProbes * kProbes; ++k) {
        const glm::dvec2 share = glm::dvec2(k % kProbes + 1, k / kProbes + 1) / double(kProbes + 1);
        const glm::dvec2 crs = affine_.crs_from_grid(share * glm::dvec2(width - 1, height - 1));
        glm::dvec2 degrees = crs;
        transform_.degrees_from_crs({&degrees, 1});
        const double moved = std::abs(std::remainder(degrees.x - crs.x, 360.0)) + std::abs(degrees.y - crs.y);
        if (!(moved < 4e-10)) return false;  // 0.04 mm
    }
    return true;
}

void RasterPlace::sites_from_grid(std::span<glm::dvec2> points) const {
    for (glm::dvec2& point : points)
        point = affine_.crs_from_grid(point);
    if (!has_datum()) return;
    if (!is_site_crs_) transform_.degrees_from_crs(points);
    for (glm::dvec2& point : points) {
        if (std::abs(point.y) <= 90.0 + kLatitudeSlack) point.y = std::clamp(point.y, -90.0, 90.0);
    }
}

void RasterPlace::grid_from_sites(std::span<glm::dvec2> points) const {
    if (!is_site_crs_) transform_.crs_from_degrees(points);
    const double turn = transform_.full_turn();
    for (glm::dvec2& point : points) {
        if (turn > 0.0) point.x += turn * std::round((middle_x_ - point.x) / turn);
        point = affine_.grid_from_crs(point);
    }
}

}  // namespace data
