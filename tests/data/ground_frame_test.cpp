#include "data/ground_frame.h"

#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <GeographicLib/Geocentric.hpp>
#include <chrono>
#include <cmath>
#include <string>

#include "lod/base/rng.h"

namespace {

using data::GroundFrame;
using data::SitePoint;

std::string wkt_of(const std::string& name) {
    OGRSpatialReference srs;
    EXPECT_EQ(srs.SetFromUserInput(name.c_str()), OGRERR_NONE);
    char* text = nullptr;
    srs.exportToWkt(&text);
    const std::string wkt = text;
    CPLFree(text);
    return wkt;
}

// A raster as a test case: where it lies, and what the code is allowed to be off.
struct Case {
    std::string name, crs;
    std::array<double, 6> geo_transform;
    int width, height;
    double tolerance_m;
};

const Case kCases[] = {
    {"srtm", "EPSG:4326", {6.99958333, 1.0 / 1200, 0, 44.00041667, 0, -1.0 / 1200}, 1201, 1201, 1e-8},
    {"world", "EPSG:4326", {-180, 0.5, 0, 90, 0, -0.5}, 720, 360, 1e-8},
    {"antimeridian", "EPSG:4326", {179.5, 1.0 / 600, 0, -16, 0, -1.0 / 600}, 601, 601, 1e-8},
    {"longitude to 360", "EPSG:4326", {236.5, 1.0 / 600, 0, 48, 0, -1.0 / 600}, 601, 601, 1e-8},
    {"rotated", "EPSG:4326", {7, 1e-4, 8e-4, 44, -8e-4, 1e-4}, 800, 700, 1e-3},
    {"nad27", "EPSG:4267", {-104, 1.0 / 1200, 0, 44, 0, -1.0 / 1200}, 700, 900, 1e-3},
    {"utm", "EPSG:32611", {376313.655, 30, 0, 3807917.828, 0, -30}, 1197, 643, 1e-3},
    {"utm turned", "EPSG:32633", {400000, 20, 10, 5300000, 10, -20}, 999, 1300, 1e-3},
    {"british grid", "EPSG:27700", {320999.997, 2, 0, 130799.9997, 0, -2}, 900, 900, 1e-3},
    {"feet", "EPSG:2263", {980000, 50, 0, 220000, 0, -50}, 700, 700, 1e-3},
    {"web mercator", "EPSG:3857", {1e6, 100, 0, 9e6, 0, -100}, 3000, 3000, 1e-3},
    {"south pole", "EPSG:3031", {-500000, 1000, 0, 500000, 0, -1000}, 1000, 1000, 1e-3},
    {"row", "EPSG:32611", {376313, 30, 0, 3807917, 0, -30}, 500, 1, 1e-3},
    {"single", "EPSG:32611", {376313, 30, 0, 3807917, 0, -30}, 1, 1, 1e-3},
};

GroundFrame frame_of(const Case& c) {
    const auto frame = GroundFrame::make(c.geo_transform, wkt_of(c.crs), c.width, c.height);
    EXPECT_TRUE(frame) << c.name << ": " << frame.message();
    return frame ? *frame : GroundFrame{};
}

// PROJ and GeographicLib, one point at a time.
struct Oracle {
    explicit Oracle(const Case& c) : raster(c) {
        source.SetFromUserInput(c.crs.c_str());
        source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        wgs84.SetWellKnownGeogCS("WGS84");
        wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        transform.reset(OGRCreateCoordinateTransformation(&source, &wgs84));
    }
    glm::dvec3 world(double col, double row, double height_m) const {
        const auto& g = raster.geo_transform;
        double x = g[0] + (col + 0.5) * g[1] + (row + 0.5) * g[2];
        double y = g[3] + (col + 0.5) * g[4] + (row + 0.5) * g[5];
        if (raster.crs != "EPSG:4326") {
            EXPECT_TRUE(transform->Transform(1, &x, &y));
        }
        glm::dvec3 world;
        GeographicLib::Geocentric::WGS84().Forward(y, x, height_m, world.x, world.y, world.z);
        return world;
    }
    Case raster;
    OGRSpatialReference source, wgs84;
    std::unique_ptr<OGRCoordinateTransformation> transform;
};

TEST(GroundFrame, SamplesLieWhereProjAndGeographicLibPutThem) {
    lod::Rng rng(3);
    for (const Case& c : kCases) {
        const GroundFrame frame = frame_of(c);
        const Oracle oracle(c);
        double worst_m = 0.0;
        for (int i = 0; i < 3000; ++i) {
            const int col = static_cast<int>(rng.below(static_cast<uint64_t>(c.width)));
            const int row = static_cast<int>(rng.below(static_cast<uint64_t>(c.height)));
            const double h = rng.between(-500, 9000);
            const double off_m =
                glm::distance(frame.world_from_sample(col, row, h), oracle.world(col, row, h));
            worst_m = std::max(worst_m, off_m);
        }
        EXPECT_LE(worst_m, c.tolerance_m) << c.name;
        RecordProperty(c.name, std::to_string(worst_m));
    }
}

TEST(GroundFrame, FractionalPositionsGoThereAndBack) {
    lod::Rng rng(4);
    for (const Case& c : kCases) {
        const GroundFrame frame = frame_of(c);
        const Oracle oracle(c);
        for (int i = 0; i < 200; ++i) {
            const double col = rng.between(0, c.width - 0.9), row = rng.between(0, c.height - 0.9);
            ASSERT_LT(glm::distance(frame.world_from_grid(col, row, 77), oracle.world(col, row, 77)), 1e-6)
                << c.name;
            const SitePoint site = frame.site_from_grid(col, row);
            ASSERT_LE(std::abs(site.x), 180.0);
            ASSERT_LT(glm::distance(frame.world().world_from_site({site.x, site.y, 77}),
                                    oracle.world(col, row, 77)),
                      1e-6);
            const glm::dvec2 back = frame.grid_from_site(site);
            ASSERT_LT(glm::distance(back, glm::dvec2(col, row)), 1e-3) << c.name;
        }
    }
}

// A point of a chord or triangle, and the same point on the true surface, split by the local vertical there.
struct Parts {
    double up_m, side_m;
};
Parts split(const GroundFrame& frame, const glm::dvec2& grid, double h, const glm::dvec3& interpolated) {
    const glm::dvec3 truth = frame.world_from_grid(grid.x, grid.y, h);
    const glm::dvec3 up = glm::normalize(frame.world_from_grid(grid.x, grid.y, h + 1000.0) - truth);
    const double along = glm::dot(interpolated - truth, up);
    return {std::abs(along), glm::length(interpolated - truth - along * up)};
}

TEST(GroundFrame, ChordErrorBoundsSegmentsAndTriangles) {
    lod::Rng rng(5);
    for (const Case& c : kCases) {
        if (c.width < 2) continue;
        const GroundFrame frame = frame_of(c);
        const GroundFrame::ChordError bound = frame.chord_error_per_cell2();
        double tightness_up = 0.0, tightness_side = 0.0;
        const auto point = [&] {
            return glm::dvec2(rng.between(0, c.width - 1), rng.between(0, c.height - 1));
        };
        for (int i = 0; i < 600; ++i) {
            // Short, long, and the whole raster; heights to the limit the header names.
            const glm::dvec2 middle = point();
            const double reach = std::pow(rng.unit(), 2.0);
            const double h = i % 3 == 0 ? 12000.0 : rng.between(-500, 9000);
            glm::dvec2 corner[3];
            for (auto& p : corner)
                p = middle + (point() - middle) * reach;
            if (i % 2 == 0) {  // a right isosceles triangle, as the bintree has; else a segment
                const glm::dvec2 half = (corner[1] - corner[0]) * 0.5;
                corner[2] = corner[0] + half + glm::dvec2(-half.y, half.x);
            } else {
                corner[2] = corner[1];
            }
            bool is_inside = true;
            for (const auto& p : corner) {
                is_inside = is_inside && p.x >= 0 && p.y >= 0 && p.x <= c.width - 1 && p.y <= c.height - 1;
            }
            const double n = glm::distance(corner[0], corner[1]);
            if (!is_inside || n == 0.0) continue;
            for (int k = 0; k < 8; ++k) {
                double a = rng.unit(), b = rng.unit();
                if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
                glm::dvec3 world{0.0};
                glm::dvec2 grid{0.0};
                const double weight[3] = {1.0 - a - b, a, b};
                for (int v = 0; v < 3; ++v) {
                    world += weight[v] * frame.world_from_grid(corner[v].x, corner[v].y, h);
                    grid += weight[v] * corner[v];
                }
                const Parts off = split(frame, grid, h, world);
                ASSERT_LE(off.up_m, n * n * bound.up_m + 1e-6) << c.name << " n " << n;
                ASSERT_LE(off.side_m, n * n * bound.side_m + 1e-6) << c.name << " n " << n;
                if (off.up_m > 1e-4) tightness_up = std::max(tightness_up, off.up_m / (n * n * bound.up_m));
                if (off.side_m > 1e-4)
                    tightness_side = std::max(tightness_side, off.side_m / (n * n * bound.side_m));
            }
        }
        EXPECT_GT(tightness_up, 0.3) << c.name;
    }
}

TEST(GroundFrame, PlanarIsTheAffineMap) {
    const auto frame = GroundFrame::make({100, 2, 0.5, 50, 0.25, -3}, "", 10, 8);
    ASSERT_TRUE(frame);
    EXPECT_FALSE(frame->world().has_datum);
    EXPECT_EQ(frame->world_from_sample(0, 0, 7), glm::dvec3(101.25, 48.625, 7));
    EXPECT_EQ(frame->world_from_sample(4, 2, 7), glm::dvec3(110.25, 43.625, 7));
    EXPECT_NEAR(frame->cell_m().x, std::hypot(2, 0.25), 1e-12);
    EXPECT_NEAR(frame->cell_m().y, std::hypot(0.5, 3), 1e-12);
    EXPECT_EQ(frame->chord_error_per_cell2().up_m, 0.0);
    EXPECT_LT(glm::distance(frame->grid_from_site({110.25, 43.625, 0}), glm::dvec2(4, 2)), 1e-12);
}

TEST(GroundFrame, CellsHaveTheirSizeInMetres) {
    const GroundFrame srtm = frame_of(kCases[0]);
    // At 43.5 degrees: a degree of longitude is 80.8 km, of latitude 111.1 km.
    EXPECT_NEAR(srtm.cell_m().x, 67.34, 0.1);
    EXPECT_NEAR(srtm.cell_m().y, 92.58, 0.1);
    const auto local = GroundFrame::make({0, 5, 0, 0, 0, -5}, "LOCAL_CS[\"site\",UNIT[\"metre\",1]]", 4, 4);
    ASSERT_TRUE(local) << local.message();
    EXPECT_FALSE(local->world().has_datum);
}

TEST(GroundFrame, RefusesWhatHasNoPlace) {
    const auto failure = [](const std::array<double, 6>& g, const std::string& crs) {
        const auto frame = GroundFrame::make(g, crs, 10, 10);
        EXPECT_FALSE(frame) << crs;
        return frame ? std::string() : frame.message();
    };
    EXPECT_NE(failure({0, 1, 0, 0, 0, 0}, "").find("invertible"), std::string::npos);
    EXPECT_NE(failure({0, 1, 0, NAN, 0, -1}, "").find("finite"), std::string::npos);
    EXPECT_NE(failure({0, 1, 0, 0, 0, -1}, "GEOGCS[broken").find("CRS"), std::string::npos);
    EXPECT_NE(failure({0, 1, 0, 0, 0, -1}, "EPSG:4978").find("geographic or projected"), std::string::npos);
    EXPECT_NE(failure({0, 1, 0, 95, 0, -1}, wkt_of("EPSG:4326")).find("latitude"), std::string::npos);
    EXPECT_NE(failure({500000, 30, 0, 4e7, 0, -30}, wkt_of("EPSG:3035")).find("Earth"), std::string::npos);
}

TEST(GroundFrame, IsFast) {
    for (const Case& c : {kCases[0], kCases[6]}) {
        const GroundFrame frame = frame_of(c);
        constexpr int kCalls = 1'000'000;
        glm::dvec3 sum{0.0};
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < kCalls; ++i) {
            const auto mixed = static_cast<uint32_t>(i) * 2654435761u;
            sum += frame.world_from_sample(static_cast<int>(mixed % static_cast<uint32_t>(c.width)),
                                           static_cast<int>((mixed >> 8) % static_cast<uint32_t>(c.height)),
                                           100.0);
        }
        const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
        std::printf("%-18s %.1f ns per sample (%g)\n", c.name.c_str(), spent.count() / kCalls, sum.x);
        EXPECT_LT(spent.count() / kCalls, 1000.0) << c.name;  // far above what it takes, far below PROJ
    }
}

}  // namespace
