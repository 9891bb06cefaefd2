#include "data/height_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "data/ground_height.h"
#include "tests/data/relief.h"

namespace {

using data::HeightGrid;
using test::count_voids;
using test::expect_invariants;
using test::failure;
using test::RasterSpec;
using test::read;

struct RealRaster {
    std::string path;
    int width, height;
    double min_m, max_m;
    int64_t voids;  // -1: not known beforehand
};

const RealRaster kReal[] = {
    {"monaco/N43E007.hgt.zip", 1201, 1201, -11, 2064, 1595},
    {"terrain/N48W125.hgt.zip", 3601, 3601, NAN, NAN, -1},
    {"terrain/mt_rainier_90m.tif", 1201, 1201, NAN, 4376, -1},
    {"terrain/mt_fuji_90m.tif", 1201, 1201, NAN, NAN, -1},
    {"terrain/srtm_bigtujunga30m_utm11.tif", 1197, 643, NAN, NAN, -1},
    {"terrain/sfdem_declared_nodata.tif", 634, 477, NAN, NAN, -1},
    {"terrain/gtopo30_w030n60_recompressed.tif", 3600, 3600, NAN, NAN, -1},
    {"terrain/dem_gaps.tif", 373, 350, NAN, NAN, -1},
    {"terrain/jacksboro_srtm3.tif", 403, 344, NAN, NAN, 0},
    {"somerset/somerset_dtm_2m.tif", 900, 900, NAN, NAN, 0},
};

// Compares every sample with what GDAL itself delivers, and a few with GDAL's idea of where they lie.
void compare_with_gdal(const HeightGrid& grid, const std::string& gdal_name) {
    GDALDatasetH dataset = GDALOpen(gdal_name.c_str(), GA_ReadOnly);
    ASSERT_NE(dataset, nullptr) << gdal_name;
    const size_t width = static_cast<size_t>(grid.width);
    std::vector<double> line(width);
    size_t wrong = 0;
    for (int row = 0; row < grid.height; ++row) {
        ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Read, 0, row, grid.width, 1, line.data(),
                               grid.width, 1, GDT_Float64, 0, 0),
                  CE_None);
        for (int col = 0; col < grid.width; ++col) {
            const double raw = line[static_cast<size_t>(col)];
            const bool is_height = raw > -500.0 && raw < 9000.0;  // all of these stand on land
            wrong += is_height ? grid.void_at(col, row) || double{grid.at(col, row)} != raw
                               : !grid.void_at(col, row);
        }
    }
    EXPECT_EQ(wrong, 0u);
    double g[6];
    GDALGetGeoTransform(dataset, g);
    OGRSpatialReferenceH srs = OSRClone(GDALGetSpatialRef(dataset)), wgs84 = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(wgs84, "EPSG:4326");
    OSRSetAxisMappingStrategy(srs, OAMS_TRADITIONAL_GIS_ORDER);
    OSRSetAxisMappingStrategy(wgs84, OAMS_TRADITIONAL_GIS_ORDER);
    OGRCoordinateTransformationH transform = OCTNewCoordinateTransformation(srs, wgs84);
    for (double share : {0.0, 0.3, 0.9}) {
        const int col = static_cast<int>(share * (grid.width - 1)),
                  row = static_cast<int>(share * (grid.height - 1));
        double x = g[0] + (col + 0.5) * g[1], y = g[3] + (row + 0.5) * g[5];
        ASSERT_TRUE(OCTTransform(transform, 1, &x, &y, nullptr));
        const data::SitePoint site = grid.frame.site_from_grid(col, row);
        EXPECT_NEAR(site.x, x, 1e-10);
        EXPECT_NEAR(site.y, y, 1e-10);
    }
    OCTDestroyCoordinateTransformation(transform);
    OSRRelease(srs);
    OSRRelease(wgs84);
    GDALClose(dataset);
}

TEST(HeightGrid, RealRastersAreReadAsGdalReadsThem) {
    if (!test::exists(test::real_data("terrain"))) GTEST_SKIP() << "no shared/data beside the project";
    for (const RealRaster& real : kReal) {
        SCOPED_TRACE(real.path);
        const std::string path = test::real_data(real.path);
        const HeightGrid grid = read({path});
        ASSERT_EQ(grid.width, real.width);
        ASSERT_EQ(grid.height, real.height);
        expect_invariants(grid);
        if (!std::isnan(real.min_m)) {
            EXPECT_EQ(double{grid.min_m}, real.min_m);
        }
        if (!std::isnan(real.max_m)) {
            EXPECT_NEAR(double{grid.max_m}, real.max_m, 20.0);
        }
        if (real.voids >= 0) {
            EXPECT_EQ(count_voids(grid), static_cast<size_t>(real.voids));
        }
        EXPECT_GE(double{grid.min_m}, -420.0);
        EXPECT_LE(double{grid.max_m}, 4900.0);
        const bool is_zip = path.ends_with(".zip");
        const size_t slash = path.rfind('/') + 1;
        compare_with_gdal(grid, is_zip ? "/vsizip/" + path + "/" + path.substr(slash, 11) : path);
    }
}

TEST(HeightGrid, SrtmSamplesLieOnWholeDegrees) {
    const std::string path = test::real_data("monaco/N43E007.hgt.zip");
    if (!test::exists(path)) GTEST_SKIP() << "no shared/data beside the project";
    const HeightGrid grid = read({path});
    const data::SitePoint north_west = grid.frame.site_from_grid(0, 0);
    EXPECT_NEAR(north_west.x, 7.0, 1e-9);
    EXPECT_NEAR(north_west.y, 44.0, 1e-9);
    EXPECT_LT(glm::distance(grid.frame.grid_from_site({8.0, 43.0, 0.0}), glm::dvec2(1200, 1200)), 1e-6);
    // The sea off Monaco is 0, Mont Agel above it some 1,100 m.
    const glm::dvec2 sea = grid.frame.grid_from_site({7.44, 43.72, 0});
    EXPECT_EQ(data::ground_height(grid, sea.x, sea.y).height_m, 0.0);
    const glm::dvec2 agel = grid.frame.grid_from_site({7.4225, 43.7755, 0});
    EXPECT_NEAR(data::ground_height(grid, agel.x, agel.y).height_m, 1110.0, 60.0);
}

TEST(HeightGrid, RefusesWithOneLine) {
    const auto expect = [](const std::vector<std::string>& paths, const std::string& part) {
        const std::string message = failure(paths);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_NE(message.find("expected"), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        if (!paths.empty()) {
            EXPECT_NE(message.find(paths[0]), std::string::npos) << message;
        }
    };
    EXPECT_FALSE(data::read_height_grid({}, {}));
    expect({"/nowhere/dem.tif"}, "No such file");
    expect({"/nowhere/dem.zip"}, "terrain");
    expect({test::write_bytes("empty.tif", {})}, "terrain");
    expect({test::write_bytes("text.tif", {'h', 'e', 'l', 'l', 'o'})}, "not recognized");
    expect({test::write_bytes("N43E007.hgt", std::vector<unsigned char>(1000))}, "terrain");
    RasterSpec one{.width = 1, .height = 1, .values = {5}};
    expect({test::write_raster("one.tif", one)}, "2 x 2");
    one = {.width = 7, .height = 1, .values = std::vector<double>(7, 5)};
    expect({test::write_raster("row.tif", one)}, "2 x 2");
    one = {.width = 3, .height = 3, .values = std::vector<double>(9, -32768)};
    expect({test::write_raster("void.tif", one)}, "every sample is void");
    one = {.width = 2,
           .height = 2,
           .values = std::vector<double>(12, 9),
           .bands = 3,
           .type = GDT_Byte,
           .options = {"PHOTOMETRIC=RGB"}};
    expect({test::write_raster("picture.tif", one)}, "picture");
    one = {.width = 2, .height = 2, .values = {1, 2, 3, 4}, .geo_transform = {7, 1, 0, 95, 0, -1}};
    expect({test::write_raster("beyond.tif", one)}, "latitude");
    one = {.width = 2, .height = 2, .values = {1, 2, 3, 4}, .type = GDT_CFloat32};
    expect({test::write_raster("complex.tif", one)}, "complex");
}

}  // namespace
