#include "data/height_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "tests/data/relief.h"

namespace {

using data::HeightGrid;
using data::VoidPolicy;
using test::count_voids;
using test::expect_invariants;
using test::failure;
using test::RasterSpec;
using test::read;
using test::relief;
using test::relief_spec;

TEST(HeightValues, EveryOrientationGivesTheSameGround) {
    const HeightGrid plain =
        read({test::write_raster("north.tif", relief_spec(30, 20, {7, 0.01, 0, 44, 0, -0.01}))});
    const struct {
        const char* name;
        int width, height;
        std::array<double, 6> g;
    } turned[] = {
        {"south-up", 30, 20, {7, 0.01, 0, 43.8, 0, 0.01}},
        {"east-left", 30, 20, {7.3, -0.01, 0, 44, 0, -0.01}},
        {"180", 30, 20, {7.3, -0.01, 0, 43.8, 0, 0.01}},
        {"90", 20, 30, {7, 0, 0.01, 43.8, 0.01, 0}},
        {"transposed", 20, 30, {7, 0, 0.01, 44, -0.01, 0}},
        {"270", 20, 30, {7.3, 0, -0.01, 44, -0.01, 0}},
        {"other", 20, 30, {7.3, 0, -0.01, 43.8, 0.01, 0}},
    };
    for (const auto& t : turned) {
        SCOPED_TRACE(t.name);
        RasterSpec spec = relief_spec(t.width, t.height, t.g);
        const HeightGrid grid = read({test::write_raster("turned.tif", spec)});
        ASSERT_EQ(grid.width, 30);
        ASSERT_EQ(grid.height, 20);
        for (int row = 0; row < 20; ++row) {
            for (int col = 0; col < 30; ++col) {
                ASSERT_NEAR(double{grid.at(col, row)}, double{plain.at(col, row)}, 1e-3);
                ASSERT_LT(glm::distance(grid.frame.world_from_sample(col, row, 5),
                                        plain.frame.world_from_sample(col, row, 5)),
                          1e-3);
            }
        }
    }
}

TEST(HeightValues, AnObliqueRasterKeepsItsPlaces) {
    const HeightGrid grid =
        read({test::write_raster("oblique.tif", relief_spec(40, 30, {7, 0.004, 0.009, 44, 0.009, -0.004}))});
    for (int k = 0; k < 200; ++k) {
        const int col = k * 7 % grid.width, row = k * 5 % grid.height;
        const data::SitePoint site = grid.frame.site_from_grid(col, row);
        ASSERT_NEAR(double{grid.at(col, row)}, relief(site.x, site.y), 1e-3);
    }
    EXPECT_EQ(grid.width, 30);  // turned, so that rows run south rather than east
}

TEST(HeightValues, CrssThatCountWestOrSouthAreTurnedToTheNorth) {
    // The same ground in eastings and northings, and in Krovak's southings and westings: x, y exchanged and negated.
    RasterSpec spec{
        .width = 40, .height = 30, .geo_transform = {-750000, 100, 0, -1040000, 0, -100}, .crs = "EPSG:5514"};
    for (int k = 0; k < 40 * 30; ++k)
        spec.values.push_back(k);
    const HeightGrid east = read({test::write_raster("east.tif", spec)});
    spec.geo_transform = {1040000, 0, 100, 750000, -100, 0};
    spec.crs = "EPSG:5513";
    const HeightGrid west = read({test::write_raster("west.tif", spec)});
    EXPECT_EQ(west.height_m, east.height_m);
    EXPECT_LT(glm::distance(west.frame.world_from_sample(3, 20, 0), east.frame.world_from_sample(3, 20, 0)),
              1e-3);
    // South Africa's westings and southings: row 0 is the northernmost, columns run east.
    spec.geo_transform = {60000, 100, 0, 3000000, 0, 100};
    spec.crs = "EPSG:2053";
    const HeightGrid south = read({test::write_raster("south.tif", spec)});
    EXPECT_GT(south.frame.site_from_grid(20, 0).y, south.frame.site_from_grid(20, 29).y);
    EXPECT_LT(south.frame.site_from_grid(0, 15).x, south.frame.site_from_grid(39, 15).x);
}

TEST(HeightValues, PixelIsPointFilesLieHalfAPixelOff) {
    // GDAL writes the same corner geotransform either way; the file's tie point differs, the ground must not.
    RasterSpec spec = relief_spec(12, 10, {7, 0.01, 0, 44, 0, -0.01});
    const HeightGrid area = read({test::write_raster("area.tif", spec)});
    const std::string path = "/vsimem/point.tif";
    test::write_raster("point.tif", spec);
    GDALDatasetH dataset = GDALOpen(path.c_str(), GA_Update);
    GDALSetMetadataItem(dataset, "AREA_OR_POINT", "Point", nullptr);
    GDALSetGeoTransform(dataset, spec.geo_transform.data());
    GDALClose(dataset);
    EXPECT_NE(test::file_bytes(path), test::file_bytes("/vsimem/area.tif"));
    const HeightGrid point = read({path});
    EXPECT_EQ(point.frame.world_from_sample(3, 4, 0), area.frame.world_from_sample(3, 4, 0));
    EXPECT_NEAR(point.frame.site_from_grid(0, 0).x, 7.005, 1e-12);
}

TEST(HeightValues, WithoutCrsOrGeotransformItIsPlanar) {
    RasterSpec spec = relief_spec(5, 4, {100, 2, 0, 50, 0, -2});
    spec.crs.clear();
    const HeightGrid grid = read({test::write_raster("plain.tif", spec)});
    EXPECT_FALSE(grid.frame.world().has_datum);
    EXPECT_EQ(grid.frame.world_from_sample(0, 0, 9), glm::dvec3(101, 49, 9));
    const std::string ascii = test::write_bytes(
        "bare.pgm", {'P', '5', ' ', '3', ' ', '2', ' ', '2', '5', '5', '\n', 10, 20, 30, 40, 50, 60});
    const HeightGrid bare = read({ascii});
    EXPECT_EQ(bare.at(2, 1), 60.0f);
    EXPECT_LT(bare.frame.world_from_sample(0, 1, 0).y, bare.frame.world_from_sample(0, 0, 0).y);
}

TEST(HeightValues, ScaleOffsetAndUnits) {
    RasterSpec spec{.width = 2, .height = 2, .values = {1000, 2000, 3000, -500}, .type = GDT_Int16};
    const auto first = [&](const char* name) {
        return double{read({test::write_raster(name, spec)}).at(0, 0)};
    };
    EXPECT_EQ(first("u0.tif"), 1000.0);
    spec.unit = "ft";
    EXPECT_NEAR(first("u1.tif"), 304.8, 1e-4);
    spec.unit = "US survey foot";
    EXPECT_NEAR(first("u2.tif"), 1000.0 * 1200.0 / 3937.0, 1e-4);
    spec.unit = "metre";
    spec.scale = 0.1;
    spec.offset = 50;
    EXPECT_NEAR(first("u3.tif"), 150.0, 1e-4);
    spec.unit = "feet";
    EXPECT_NEAR(first("u4.tif"), 150.0 * 0.3048, 1e-4);
    spec.unit = "degrees";
    EXPECT_NE(failure({test::write_raster("u5.tif", spec)}).find("'degrees'"), std::string::npos);
    spec = {.width = 2, .height = 2, .values = {1000, 2000, 3000, -500}};
    spec.crs = "EPSG:4326+6360";  // NAVD88 in US survey feet
    EXPECT_NEAR(first("u6.tif"), 304.8, 1e-3);
    // The same where the driver does not pass the CRS's unit on to the band.
    const std::string vrt =
        "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><SRS>EPSG:4326+6360</SRS>"
        "<GeoTransform>7, 1, 0, 44, 0, -1</GeoTransform><VRTRasterBand dataType=\"Float32\" "
        "band=\"1\"><SimpleSource>"
        "<SourceFilename>/vsimem/u0.tif</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>";
    EXPECT_NEAR(double{read({test::write_bytes("u7.vrt", {vrt.begin(), vrt.end()})}).at(0, 0)}, 304.8, 1e-3);
}

TEST(HeightValues, EveryNodataCodeIsVoid) {
    const double inf = std::numeric_limits<double>::infinity();
    for (double code : {-32768.0, -32767.0, -9999.0, 12001.0, -12001.0, 3.4e38, -3.4028234663852886e38, inf,
                        -inf, double{NAN}}) {
        RasterSpec spec{.width = 3, .height = 3, .values = {1, 2, 3, 4, code, 6, 7, 8, 9}};
        const HeightGrid grid = read({test::write_raster("code.tif", spec)});
        EXPECT_EQ(count_voids(grid), 1u) << code;
        EXPECT_TRUE(grid.void_at(1, 1)) << code;
        expect_invariants(grid);
        EXPECT_EQ(grid.max_m, 9.0f);
    }
    RasterSpec good{.width = 2, .height = 2, .values = {-430, 8849, -11000, 11999}};
    EXPECT_FALSE(read({test::write_raster("good.tif", good)}).has_voids());
    RasterSpec taken{.width = 2, .height = 2, .values = {-9999, 1, 2, double{NAN}}};
    const HeightGrid as_stated = read({test::write_raster("taken.tif", taken)},
                                      {.voids = VoidPolicy::kHole, .has_undeclared_nodata = false});
    EXPECT_EQ(as_stated.at(0, 0), -9999.0f);
    EXPECT_EQ(count_voids(as_stated), 1u);
}

TEST(HeightValues, DeclaredNodataAlsoWhenInexact) {
    RasterSpec spec{.width = 2, .height = 2, .values = {5, 7, 0, 9}, .has_nodata = true, .nodata = 0};
    EXPECT_TRUE(read({test::write_raster("zero.tif", spec)}).void_at(0, 1));
    spec.values = {5, 7, double{9.99999f}, 9};
    spec.nodata = 9.99999;
    EXPECT_TRUE(read({test::write_raster("inexact.tif", spec)}).void_at(0, 1));
    EXPECT_EQ(count_voids(read({"/vsimem/inexact.tif"})), 1u);
    const std::string text =
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value 1234.567\n1 2\n1234.5671 4\n";
    const HeightGrid ascii = read({test::write_bytes("inexact.asc", {text.begin(), text.end()})});
    EXPECT_TRUE(ascii.void_at(0, 1));
    EXPECT_EQ(count_voids(ascii), 1u);
    // A packed band: raw -9999 is a height of 2,500 m there.
    RasterSpec packed{.width = 2, .height = 2, .values = {-9999, 0, 1, -32768}, .type = GDT_Int16};
    packed.scale = 0.15;
    packed.offset = 4000;
    const HeightGrid grid = read({test::write_raster("packed.tif", packed)});
    EXPECT_NEAR(double{grid.at(0, 0)}, 2500.15, 1e-3);
    EXPECT_EQ(count_voids(grid), 1u);
}

TEST(HeightValues, FillingIsSmoothAndStaysInRange) {
    // A plane with holes of several sizes, one at the border: the fill comes close to the plane.
    constexpr int kSize = 100;
    RasterSpec spec{.width = kSize, .height = kSize};
    const auto plane = [](int col, int row) { return 3.0 * col + 5.0 * row; };
    for (int row = 0; row < kSize; ++row) {
        for (int col = 0; col < kSize; ++col) {
            const bool is_hole = (std::hypot(col - 50, row - 50) < 20) || (col < 6 && row > 30 && row < 40) ||
                                 (col == 80 && row == 10);
            spec.values.push_back(is_hole ? -32768.0 : plane(col, row));
        }
    }
    const std::string path = test::write_raster("holes.tif", spec);
    const HeightGrid filled = read({path}, {.voids = VoidPolicy::kFill});
    EXPECT_FALSE(filled.has_voids());
    expect_invariants(filled);
    const HeightGrid holes = read({path});
    EXPECT_EQ(holes.height_m, filled.height_m);
    EXPECT_TRUE(holes.void_at(50, 50));
    double worst = 0.0, steepest = 0.0;
    for (int row = 30; row < 70; ++row) {
        for (int col = 30; col < 70; ++col) {
            worst = std::max(worst, std::abs(double{filled.at(col, row)} - plane(col, row)));
            steepest = std::max(steepest, double{std::abs(filled.at(col, row) - filled.at(col - 1, row))});
        }
    }
    EXPECT_LT(worst, 15.0);
    EXPECT_LT(steepest, 8.0);  // the slope itself steps by 3 along a row
    EXPECT_NEAR(double{filled.at(80, 10)}, plane(80, 10), 1e-3);
}

}  // namespace
