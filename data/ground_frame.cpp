#include "data/ground_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "data/chord_error.h"
#include "data/ecef_patches.h"
#include "data/geodetic_transform.h"

namespace data {

namespace {

using GeographicLib::Geocentric;
using GeographicLib::Math;

constexpr double kLatitudeSlack = 1e-6;  // degrees; a pole that rounding has moved

// GDAL's six numbers, moved to sample centres.
struct Affine {
    glm::dmat2 crs_from_cells{1.0};
    glm::dmat2 cells_from_crs{1.0};
    glm::dvec2 origin{0.0};  // CRS position of sample (0, 0)

    glm::dvec2 forward(const glm::dvec2& grid) const { return origin + crs_from_cells * grid; }
    glm::dvec2 inverse(const glm::dvec2& crs) const { return cells_from_crs * (crs - origin); }
};

lod::Result<Affine> make_affine(const std::array<double, 6>& g) {
    Affine affine;
    affine.crs_from_cells = glm::dmat2(g[1], g[4], g[2], g[5]);
    const double determinant = g[1] * g[5] - g[2] * g[4];
    bool is_finite = std::isfinite(determinant) && determinant != 0.0;
    for (double value : g)
        is_finite = is_finite && std::isfinite(value);
    if (!is_finite)
        return lod::Error{"geotransform is not invertible; expected six finite numbers, an area > 0"};
    affine.cells_from_crs = glm::inverse(affine.crs_from_cells);
    affine.origin = glm::dvec2(g[0], g[3]) + affine.crs_from_cells * glm::dvec2(0.5);
    return affine;
}

}  // namespace

struct GroundFrame::Tables {
    enum class Kind : uint8_t { kPlanar, kSeparable, kPatches };
    struct Row {  // of one latitude
        double n_cos, cos, z, sin;
    };
    struct Column {  // of one longitude
        double cos, sin;
    };

    Tables(Affine a, GeodeticTransform t) : affine(a), transform(std::move(t)) {}

    bool are_degrees_linear(int width, int height) const;
    lod::Result<lod::Ok> fill_rows_and_columns(int width, int height);
    void degrees_from_grid(std::span<const glm::dvec2> grid, std::span<double> longitude,
                           std::span<double> latitude) const;
    void ground_points(std::span<const glm::dvec2> grid, std::span<GroundPoint> out) const;

    Kind kind = Kind::kPlanar;
    Affine affine;
    GeodeticTransform transform;
    double middle_x = 0.0;        // of the raster, in the CRS; longitudes are taken to the turn around it
    std::vector<Row> rows;        // kSeparable: [height]
    std::vector<Column> columns;  // kSeparable: [width]
    EcefPatches patches;          // kPatches
};

namespace {

void ground_from_degrees(std::span<const double> longitude, std::span<const double> latitude,
                         std::span<GroundPoint> out) {
    for (size_t i = 0; i < out.size(); ++i) {
        double sin_phi = 0.0, cos_phi = 0.0, sin_lambda = 0.0, cos_lambda = 0.0;
        Math::sincosd(latitude[i], sin_phi, cos_phi);
        Math::sincosd(longitude[i], sin_lambda, cos_lambda);
        glm::dvec3& base = out[i].base;
        Geocentric::WGS84().Forward(latitude[i], longitude[i], 0.0, base.x, base.y, base.z);
        out[i].up = {cos_phi * cos_lambda, cos_phi * sin_lambda, sin_phi};
    }
}

}  // namespace

// Grid positions to WGS84 longitude and latitude; NaN where there is none.
void GroundFrame::Tables::degrees_from_grid(std::span<const glm::dvec2> grid, std::span<double> longitude,
                                            std::span<double> latitude) const {
    for (size_t i = 0; i < grid.size(); ++i) {
        const glm::dvec2 crs = affine.forward(grid[i]);
        longitude[i] = crs.x;
        latitude[i] = crs.y;
    }
    if (kind == Kind::kPatches) transform.degrees_from_crs(longitude, latitude);
    for (double& value : latitude) {
        if (std::abs(value) <= 90.0 + kLatitudeSlack) value = std::clamp(value, -90.0, 90.0);
    }
}

void GroundFrame::Tables::ground_points(std::span<const glm::dvec2> grid, std::span<GroundPoint> out) const {
    std::vector<double> longitude(grid.size()), latitude(grid.size());
    degrees_from_grid(grid, longitude, latitude);
    ground_from_degrees(longitude, latitude, out);
}

// Longitude depends on the column alone, latitude on the row, and both are WGS84 degrees.
bool GroundFrame::Tables::are_degrees_linear(int width, int height) const {
    if (transform.kind() != CrsKind::kGeographic) return false;
    if (affine.crs_from_cells[0].y != 0.0 || affine.crs_from_cells[1].x != 0.0) return false;
    constexpr int kProbes = 5;
    for (int k = 0; k < kProbes * kProbes; ++k) {
        const glm::dvec2 share = glm::dvec2(k % kProbes + 1, k / kProbes + 1) / double(kProbes + 1);
        const glm::dvec2 crs = affine.forward(share * glm::dvec2(width - 1, height - 1));
        double x = crs.x, y = crs.y;
        transform.degrees_from_crs({&x, 1}, {&y, 1});
        const bool is_same =
            std::abs(std::remainder(x - crs.x, 360.0)) < 1e-12 * 360.0 && std::abs(y - crs.y) < 1e-12 * 90.0;
        if (!is_same) return false;
    }
    return true;
}

lod::Result<lod::Ok> GroundFrame::Tables::fill_rows_and_columns(int width, int height) {
    const double a = Geocentric::WGS84().EquatorialRadius(), f = Geocentric::WGS84().Flattening();
    const double eccentricity2 = f * (2.0 - f);
    rows.reserve(static_cast<size_t>(height));
    for (int row = 0; row < height; ++row) {
        const double latitude = affine.forward({0.0, double(row)}).y;
        if (std::abs(latitude) > 90.0 + kLatitudeSlack) {
            return lod::Error{"row " + std::to_string(row) + " lies at latitude " + std::to_string(latitude) +
                              "; expected -90 to 90"};
        }
        Row entry{};
        Math::sincosd(std::clamp(latitude, -90.0, 90.0), entry.sin, entry.cos);
        const double n = a / std::sqrt(1.0 - eccentricity2 * entry.sin * entry.sin);
        entry.n_cos = n * entry.cos;
        entry.z = n * (1.0 - eccentricity2) * entry.sin;
        rows.push_back(entry);
    }
    columns.reserve(static_cast<size_t>(width));
    for (int col = 0; col < width; ++col) {
        Column entry{};
        Math::sincosd(affine.forward({double(col), 0.0}).x, entry.sin, entry.cos);
        columns.push_back(entry);
    }
    return lod::Ok{};
}

lod::Result<GroundFrame> GroundFrame::make(const std::array<double, 6>& geo_transform,
                                           const std::string& crs_wkt, int width, int height) {
    CHECK(width >= 1 && height >= 1);
    const auto affine = make_affine(geo_transform);
    if (!affine) return affine.error();
    auto transform = GeodeticTransform::make(crs_wkt);
    if (!transform) return transform.error();

    const auto tables = std::make_shared<Tables>(*affine, std::move(*transform));
    const glm::dvec2 middle = glm::dvec2(width - 1, height - 1) * 0.5;
    tables->middle_x = tables->affine.forward(middle).x;
    GroundFrame frame;
    frame.tables_ = tables;
    frame.world_.has_datum = tables->transform.kind() != CrsKind::kNone;
    if (frame.world_.has_datum) {
        const ExactGround exact = [&tables = *tables](auto grid, auto out) {
            tables.ground_points(grid, out);
        };
        if (tables->are_degrees_linear(width, height)) {
            tables->kind = Tables::Kind::kSeparable;
            if (const auto filled = tables->fill_rows_and_columns(width, height); !filled)
                return filled.error();
        } else {
            tables->kind = Tables::Kind::kPatches;
            auto patches = EcefPatches::fit(width, height, exact);
            if (!patches) return patches.error();
            tables->patches = std::move(*patches);
        }
        frame.chord_error_ = chord_error_of(width, height, exact);
    }
    const auto distance = [&](const glm::dvec2& step) {
        return glm::distance(frame.world_from_grid(middle.x - step.x, middle.y - step.y, 0.0),
                             frame.world_from_grid(middle.x + step.x, middle.y + step.y, 0.0));
    };
    frame.cell_m_ = {distance({0.5, 0.0}), distance({0.0, 0.5})};
    return frame;
}

glm::dvec3 GroundFrame::world_from_sample(int col, int row, double height_m) const {
    DCHECK(tables_);
    const Tables& t = *tables_;
    switch (t.kind) {
        case Tables::Kind::kPatches:
            return t.patches.at(col, row, height_m);
        case Tables::Kind::kSeparable: {
            const Tables::Row& r = t.rows[static_cast<size_t>(row)];
            const Tables::Column& c = t.columns[static_cast<size_t>(col)];
            const double from_axis = r.n_cos + height_m * r.cos;
            return {from_axis * c.cos, from_axis * c.sin, r.z + height_m * r.sin};
        }
        case Tables::Kind::kPlanar:
            break;
    }
    return {t.affine.forward(glm::dvec2(col, row)), height_m};
}

glm::dvec3 GroundFrame::world_from_grid(double col, double row, double height_m) const {
    SitePoint site = site_from_grid(col, row);
    site.height_m = height_m;
    return world_.world_from_site(site);
}

glm::dvec2 GroundFrame::grid_from_site(const SitePoint& site) const {
    CHECK(tables_);
    const Tables& t = *tables_;
    glm::dvec2 crs(site.x, site.y);
    if (t.kind == Tables::Kind::kPatches) t.transform.crs_from_degrees({&crs.x, 1}, {&crs.y, 1});
    const double turn = t.transform.full_turn();
    if (turn > 0.0) crs.x += turn * std::round((t.middle_x - crs.x) / turn);
    return t.affine.inverse(crs);
}

SitePoint GroundFrame::site_from_grid(double col, double row) const {
    CHECK(tables_);
    const Tables& t = *tables_;
    if (t.kind == Tables::Kind::kPlanar) {
        const glm::dvec2 xy = t.affine.forward({col, row});
        return {xy.x, xy.y, 0.0};
    }
    const glm::dvec2 grid(col, row);
    SitePoint site;
    t.degrees_from_grid({&grid, 1}, {&site.x, 1}, {&site.y, 1});
    site.x = Math::AngNormalize(site.x);
    return site;
}

}  // namespace data
