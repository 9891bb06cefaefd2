#include "data/ground_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>
#include <span>

#include "data/chord_error.h"
#include "data/ecef_patches.h"
#include "data/raster_place.h"

namespace data {

using GeographicLib::Geocentric;
using GeographicLib::Math;

struct GroundFrame::Tables {
    enum class Kind : uint8_t { kPlanar, kSeparable, kPatches };
    struct Row {  // of one latitude
        double n_cos, cos, z, sin;
    };
    struct Column {  // of one longitude
        double cos, sin;
    };

    Tables(RasterPlace p, const std::array<double, 6>& g, const std::string& crs)
        : place(std::move(p)), geo_transform(g), crs_wkt(crs) {}
    lod::Result<lod::Ok> fill_rows_and_columns(int width, int height);
    void ground_points(std::span<const glm::dvec2> grid, std::span<GroundPoint> out) const;

    Kind kind = Kind::kPlanar;
    RasterPlace place;
    std::array<double, 6> geo_transform;
    std::string crs_wkt;
    std::vector<Row> rows;        // kSeparable: [height]
    std::vector<Column> columns;  // kSeparable: [width]
    EcefPatches patches;          // kPatches
};

// By the full transformation; NaN where there is no place.
void GroundFrame::Tables::ground_points(std::span<const glm::dvec2> grid, std::span<GroundPoint> out) const {
    std::vector<glm::dvec2> degrees(grid.begin(), grid.end());
    place.sites_from_grid(degrees);
    for (size_t i = 0; i < out.size(); ++i) {
        glm::dvec3 &base = out[i].base, &up = out[i].up;
        Geocentric::WGS84().Forward(degrees[i].y, degrees[i].x, 0.0, base.x, base.y, base.z);
        double cos_phi = 0.0, sin_lambda = 0.0, cos_lambda = 0.0;
        Math::sincosd(degrees[i].y, up.z, cos_phi);
        Math::sincosd(degrees[i].x, sin_lambda, cos_lambda);
        up.x = cos_phi * cos_lambda;
        up.y = cos_phi * sin_lambda;
    }
}

// For unrotated rasters in WGS84 degrees: latitude is the row's, longitude the column's.
lod::Result<lod::Ok> GroundFrame::Tables::fill_rows_and_columns(int width, int height) {
    const double a = Geocentric::WGS84().EquatorialRadius(), f = Geocentric::WGS84().Flattening();
    const double eccentricity2 = f * (2.0 - f);
    rows.resize(static_cast<size_t>(height));
    for (size_t i = 0; i < rows.size(); ++i) {
        glm::dvec2 site(0.0, static_cast<double>(i));
        place.sites_from_grid({&site, 1});
        if (!(std::abs(site.y) <= 90.0)) {
            return lod::Error{"row " + std::to_string(i) + " lies at latitude " + std::to_string(site.y) +
                              "; expected -90 to 90"};
        }
        Row& row = rows[i];
        Math::sincosd(site.y, row.sin, row.cos);
        const double n = a / std::sqrt(1.0 - eccentricity2 * row.sin * row.sin);
        row.n_cos = n * row.cos;
        row.z = n * (1.0 - eccentricity2) * row.sin;
    }
    columns.resize(static_cast<size_t>(width));
    for (size_t i = 0; i < columns.size(); ++i) {
        const double longitude = place.affine().crs_from_grid({static_cast<double>(i), 0.0}).x;
        Math::sincosd(longitude, columns[i].sin, columns[i].cos);
    }
    return lod::Ok{};
}

lod::Result<GroundFrame> GroundFrame::make(const std::array<double, 6>& geo_transform,
                                           const std::string& crs_wkt, int width, int height) {
    CHECK(width >= 1 && height >= 1);
    auto place = RasterPlace::make(geo_transform, crs_wkt, width, height);
    if (!place) return place.error();

    const auto tables = std::make_shared<Tables>(std::move(*place), geo_transform, crs_wkt);
    GroundFrame frame;
    frame.tables_ = tables;
    frame.world_.has_datum = tables->place.has_datum();
    if (frame.world_.has_datum) {
        const ExactGround exact = [&tables = *tables](auto grid, auto out) {
            tables.ground_points(grid, out);
        };
        const bool is_rotated = geo_transform[2] != 0.0 || geo_transform[4] != 0.0;
        if (tables->place.is_site_crs() && !is_rotated) {
            tables->kind = Tables::Kind::kSeparable;
            if (const auto done = tables->fill_rows_and_columns(width, height); !done) return done.error();
        } else {
            tables->kind = Tables::Kind::kPatches;
            auto patches = EcefPatches::fit(width, height, exact);
            if (!patches) return patches.error();
            tables->patches = std::move(*patches);
        }
        frame.chord_error_ = chord_error_of(width, height, exact);
    }
    const glm::dvec2 middle = glm::dvec2(width - 1, height - 1) * 0.5;
    const auto reach = [&](double cols, double rows) {
        return glm::distance(frame.world_from_grid(middle.x - cols, middle.y - rows, 0.0),
                             frame.world_from_grid(middle.x + cols, middle.y + rows, 0.0));
    };
    frame.cell_m_ = {reach(0.5, 0.0), reach(0.0, 0.5)};
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
    return {t.place.affine().crs_from_grid(glm::dvec2(col, row)), height_m};
}

glm::dvec3 GroundFrame::world_from_grid(double col, double row, double height_m) const {
    SitePoint site = site_from_grid(col, row);
    site.height_m = height_m;
    return world_.world_from_site(site);
}

glm::dvec2 GroundFrame::grid_from_site(const SitePoint& site) const {
    CHECK(tables_);
    glm::dvec2 point(site.x, site.y);
    tables_->place.grid_from_sites({&point, 1});
    return point;
}

void GroundFrame::grid_from_sites(std::span<glm::dvec3> points) const {
    CHECK(tables_);
    std::array<glm::dvec2, 64> block;
    while (!points.empty()) {
        const size_t count = std::min(points.size(), block.size());
        for (size_t i = 0; i < count; ++i)
            block[i] = glm::dvec2(points[i]);
        tables_->place.grid_from_sites({block.data(), count});
        for (size_t i = 0; i < count; ++i)
            points[i] = {block[i], points[i].z};
        points = points.subspan(count);
    }
}

void GroundFrame::grid_from_world(std::span<glm::dvec3> points) const {
    for (glm::dvec3& point : points) {
        const SitePoint site = world_.site_from_world(point);
        point = {site.x, site.y, site.height_m};
    }
    grid_from_sites(points);
}

const std::array<double, 6>& GroundFrame::geo_transform() const {
    CHECK(tables_);
    return tables_->geo_transform;
}

const std::string& GroundFrame::crs_wkt() const {
    CHECK(tables_);
    return tables_->crs_wkt;
}

glm::dvec2 GroundFrame::full_turn_cells() const {
    CHECK(tables_);
    return tables_->place.full_turn_cells();
}

SitePoint GroundFrame::site_from_grid(double col, double row) const {
    CHECK(tables_);
    glm::dvec2 point(col, row);
    tables_->place.sites_from_grid({&point, 1});
    return {world_.has_datum ? Math::AngNormalize(point.x) : point.x, point.y, 0.0};
}

}  // namespace data
