#include "data/height_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lod/base/rng.h"
#include "tests/data/raster_writer.h"

namespace {

using data::HeightGrid;
using data::HeightGridOptions;
using data::VoidPolicy;
using test::RasterSpec;

constexpr HeightGridOptions kHoles{.voids = VoidPolicy::kHole};

HeightGrid read(const std::vector<std::string>& paths, const HeightGridOptions& options = kHoles) {
    auto grid = data::read_height_grid(paths, options);
    EXPECT_TRUE(grid) << grid.message();
    return grid ? std::move(*grid) : data::make_planar_grid(2, 2, 1.0, {0, 0, 0, 0});
}

std::string failure(const std::vector<std::string>& paths) {
    const auto grid = data::read_height_grid(paths, {});
    EXPECT_FALSE(grid) << paths[0];
    return grid ? std::string() : grid.message();
}

// A relief that is a function of the site, so that any raster of it can be checked anywhere.
double relief(double x, double y) {
    return 800.0 + 300.0 * std::sin(9.0 * x) + 250.0 * std::cos(7.0 * y) + 40.0 * x;
}

RasterSpec relief_spec(int width, int height, const std::array<double, 6>& g) {
    RasterSpec spec{.width = width, .height = height, .geo_transform = g};
    for (int row = 0; row < height; ++row) {
        for (int col = 0; col < width; ++col) {
            spec.values.push_back(relief(g[0] + (col + 0.5) * g[1] + (row + 0.5) * g[2],
                                         g[3] + (col + 0.5) * g[4] + (row + 0.5) * g[5]));
        }
    }
    return spec;
}

size_t count_voids(const HeightGrid& grid) {
    return static_cast<size_t>(std::count(grid.is_void.begin(), grid.is_void.end(), 1));
}

void expect_invariants(const HeightGrid& grid) {
    ASSERT_EQ(grid.height_m.size(), static_cast<size_t>(grid.width) * static_cast<size_t>(grid.height));
    const auto [low, high] = std::minmax_element(grid.height_m.begin(), grid.height_m.end());
    EXPECT_GE(*low, grid.min_m);
    EXPECT_LE(*high, grid.max_m);
    EXPECT_TRUE(
        std::all_of(grid.height_m.begin(), grid.height_m.end(), [](float h) { return std::isfinite(h); }));
    if (grid.has_voids()) {
        EXPECT_EQ(grid.is_void.size(), grid.height_m.size());
        EXPECT_GT(count_voids(grid), 0u);
    }
}

// ------------------------------------------------------------------------------------------ real rasters

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

// ------------------------------------------------------------------------------------------ orientation, place

TEST(HeightGrid, EveryOrientationGivesTheSameGround) {
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

TEST(HeightGrid, AnObliqueRasterKeepsItsPlaces) {
    const HeightGrid grid =
        read({test::write_raster("oblique.tif", relief_spec(40, 30, {7, 0.004, 0.009, 44, 0.009, -0.004}))});
    for (int k = 0; k < 200; ++k) {
        const int col = k * 7 % grid.width, row = k * 5 % grid.height;
        const data::SitePoint site = grid.frame.site_from_grid(col, row);
        ASSERT_NEAR(double{grid.at(col, row)}, relief(site.x, site.y), 1e-3);
    }
    EXPECT_EQ(grid.width, 30);  // turned, so that rows run south rather than east
}

TEST(HeightGrid, PixelIsPointFilesLieHalfAPixelOff) {
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

TEST(HeightGrid, WithoutCrsOrGeotransformItIsPlanar) {
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

// ------------------------------------------------------------------------------------------ values

TEST(HeightGrid, ScaleOffsetAndUnits) {
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
}

TEST(HeightGrid, EveryNodataCodeIsVoid) {
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

TEST(HeightGrid, DeclaredNodataAlsoWhenInexact) {
    RasterSpec spec{.width = 2, .height = 2, .values = {5, 7, 0, 9}, .has_nodata = true, .nodata = 0};
    EXPECT_TRUE(read({test::write_raster("zero.tif", spec)}).void_at(0, 1));
    spec.values = {5, 7, double{9.99999f}, 9};
    spec.nodata = 9.99999;
    EXPECT_TRUE(read({test::write_raster("inexact.tif", spec)}).void_at(0, 1));
    EXPECT_EQ(count_voids(read({"/vsimem/inexact.tif"})), 1u);
    // A packed band: raw -9999 is a height of 2,500 m there.
    RasterSpec packed{.width = 2, .height = 2, .values = {-9999, 0, 1, -32768}, .type = GDT_Int16};
    packed.scale = 0.15;
    packed.offset = 4000;
    const HeightGrid grid = read({test::write_raster("packed.tif", packed)});
    EXPECT_NEAR(double{grid.at(0, 0)}, 2500.15, 1e-3);
    EXPECT_EQ(count_voids(grid), 1u);
}

TEST(HeightGrid, FillingIsSmoothAndStaysInRange) {
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
    std::printf("hole of 40 cells in a slope of 3 and 5 m per cell: off by %.1f m, steps up to %.1f m\n",
                worst, steepest);
    EXPECT_LT(worst, 30.0);
    EXPECT_LT(steepest, 15.0);
    EXPECT_NEAR(double{filled.at(80, 10)}, plane(80, 10), 1e-3);
}

// ------------------------------------------------------------------------------------------ joining

// Rectangle [col, col + width) x [row, row + height) of the relief on a grid of 0.01 degrees from 7 E, 44 N.
std::string tile(const std::string& name, glm::ivec2 at, glm::ivec2 size) {
    return test::write_raster(
        name, relief_spec(size.x, size.y, {7 + 0.01 * at.x, 0.01, 0, 44 - 0.01 * at.y, 0, -0.01}));
}

void expect_relief(const HeightGrid& grid, double tolerance_m) {
    double worst = 0.0;
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            if (grid.void_at(col, row)) continue;
            const data::SitePoint site = grid.frame.site_from_grid(col, row);
            worst = std::max(worst, std::abs(double{grid.at(col, row)} - relief(site.x, site.y)));
        }
    }
    EXPECT_LE(worst, tolerance_m);
}

TEST(HeightGrid, TilesThatShareAnEdgeJoinWithoutSeam) {
    const HeightGrid grid = read({tile("a.tif", {0, 0}, {21, 21}), tile("b.tif", {20, 0}, {21, 21}),
                                  tile("c.tif", {0, 20}, {21, 21})});
    ASSERT_EQ(grid.width, 41);
    ASSERT_EQ(grid.height, 41);
    EXPECT_EQ(count_voids(grid), 400u);  // the fourth quarter
    expect_relief(grid, 1e-3);
}

TEST(HeightGrid, PixelIsAreaNeighboursMeet) {
    const HeightGrid grid = read({tile("a.tif", {20, 10}, {20, 20}), tile("b.tif", {0, 10}, {20, 20}),
                                  tile("c.tif", {0, 0}, {40, 10})});
    ASSERT_EQ(grid.width, 40);
    ASSERT_EQ(grid.height, 30);
    EXPECT_FALSE(grid.has_voids());
    expect_relief(grid, 1e-3);
    EXPECT_NEAR(grid.frame.site_from_grid(0, 0).x, 7.005, 1e-9);
}

TEST(HeightGrid, TheFirstListedWinsWhereItIsValid) {
    RasterSpec low{.width = 4, .height = 4, .values = std::vector<double>(16, 1.0)};
    low.values[5] = -32768;
    RasterSpec high{.width = 4, .height = 4, .values = std::vector<double>(16, 2.0)};
    const HeightGrid grid = read({test::write_raster("low.tif", low), test::write_raster("high.tif", high)});
    EXPECT_EQ(grid.at(0, 0), 1.0f);
    EXPECT_EQ(grid.at(1, 1), 2.0f);
    EXPECT_FALSE(grid.has_voids());
}

TEST(HeightGrid, OtherSpacingPhaseAndCrsAreResampled) {
    const std::string first = tile("a.tif", {0, 0}, {60, 60});
    const std::string fine =
        test::write_raster("fine.tif", relief_spec(220, 240, {7.5033, 0.0027, 0, 43.9951, 0, -0.0027}));
    const HeightGrid grid = read({first, fine});
    EXPECT_GT(grid.width, 100);
    expect_relief(grid, 5.0);  // a step of the relief between samples is up to 30 m

    // The same ground in UTM: heights by the relief at each sample's longitude and latitude.
    const std::array<double, 6> g = {540000, 500, 0, 4872000, 0, -500};
    RasterSpec utm{.width = 150, .height = 90, .geo_transform = g, .crs = "EPSG:32632"};
    utm.geo_transform = {330000, 500, 0, 4872000, 0, -500};
    const auto frame = data::GroundFrame::make(utm.geo_transform, utm.crs, utm.width, utm.height);
    for (int row = 0; row < utm.height; ++row) {
        for (int col = 0; col < utm.width; ++col) {
            const data::SitePoint site = frame->site_from_grid(col, row);
            utm.values.push_back(relief(site.x, site.y));
        }
    }
    const HeightGrid mixed = read({first, test::write_raster("utm.tif", utm)});
    EXPECT_GT(mixed.width * mixed.height, 60 * 60 * 2);
    expect_relief(mixed, 5.0);
    // No gap where the two meet: every sample between their middles is valid.
    EXPECT_FALSE(mixed.void_at(mixed.width / 2, mixed.height / 2));
}

TEST(HeightGrid, ResamplingNeverMixesVoidsIn) {
    RasterSpec spec = relief_spec(40, 40, {7.6, 0.01, 0, 44.003, 0, -0.01});
    for (size_t i = 0; i < spec.values.size(); i += 7)
        spec.values[i] = i % 2 ? -32768.0 : -9999.0;
    const HeightGrid grid = read({tile("a.tif", {0, 0}, {60, 40}), test::write_raster("gaps.tif", spec)});
    EXPECT_GT(count_voids(grid), 100u);
    expect_invariants(grid);
    EXPECT_GT(grid.min_m, 100.0f);
    expect_relief(grid, 20.0);  // one-sided near a void
}

TEST(HeightGrid, TilesJoinAcrossTheAntimeridian) {
    const HeightGrid grid =
        read({test::write_raster("fiji_w.tif", relief_spec(11, 11, {179.895, 0.01, 0, -16, 0, -0.01})),
              test::write_raster("fiji_e.tif", relief_spec(11, 11, {-180.005, 0.01, 0, -16, 0, -0.01}))});
    EXPECT_EQ(grid.width, 21);
    EXPECT_EQ(grid.height, 11);
    EXPECT_FALSE(grid.has_voids());
}

TEST(HeightGrid, JoiningRefusesWhatDoesNotBelongTogether) {
    RasterSpec planar = relief_spec(5, 5, {0, 1, 0, 0, 0, -1});
    planar.crs.clear();
    EXPECT_NE(
        failure({tile("a.tif", {0, 0}, {9, 9}), test::write_raster("planar.tif", planar)}).find("no CRS"),
        std::string::npos);
    const std::string tiny = test::write_raster("tiny.tif", relief_spec(9, 9, {7, 1e-6, 0, 44, 0, -1e-6}));
    EXPECT_NE(failure({tiny, tile("a.tif", {0, 0}, {900, 9})}).find("at most"), std::string::npos);
}

TEST(HeightGrid, RealTilesCutAndJoinedAreTheWhole) {
    const std::string path = test::real_data("monaco/N43E007.hgt.zip");
    if (!test::exists(path)) GTEST_SKIP() << "no shared/data beside the project";
    const HeightGrid whole = read({path});
    std::vector<std::string> quarters;
    for (int k = 0; k < 4; ++k) {
        const int col = k % 2 * 600, row = k / 2 * 600;
        RasterSpec spec{.width = 601, .height = 601, .type = GDT_Int16};
        spec.geo_transform = {7 + (col - 0.5) / 1200, 1.0 / 1200, 0, 44 - (row - 0.5) / 1200, 0, -1.0 / 1200};
        for (int y = row; y <= row + 600; ++y) {
            for (int x = col; x <= col + 600; ++x)
                spec.values.push_back(whole.void_at(x, y) ? -32768.0 : double{whole.at(x, y)});
        }
        quarters.push_back(test::write_raster("quarter" + std::to_string(k) + ".tif", spec));
    }
    const HeightGrid joined = read(quarters);
    EXPECT_EQ(joined.height_m, whole.height_m);
    EXPECT_EQ(joined.is_void, whole.is_void);
    EXPECT_EQ(joined.frame.world_from_sample(700, 800, 0), whole.frame.world_from_sample(700, 800, 0));
}

// ------------------------------------------------------------------------------------------ broken input

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

// A file cut anywhere either fails with a line or, where only what nobody needs is lost, reads as the whole.
void expect_safe_truncations(const std::string& path, const std::string& cut_name, size_t step) {
    const HeightGrid whole = read({path});
    const std::vector<unsigned char> bytes = test::file_bytes(path);
    size_t survivors = 0;
    for (size_t size = 0; size < bytes.size(); size += step) {
        const std::string cut =
            test::write_bytes(cut_name, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
        const auto grid = data::read_height_grid({cut}, kHoles);
        if (!grid) {
            ASSERT_NE(grid.message().find(cut_name), std::string::npos) << grid.message();
            ASSERT_EQ(grid.message().find('\n'), std::string::npos) << grid.message();
        } else {
            ++survivors;
            ASSERT_EQ(grid->height_m, whole.height_m) << path << " cut at " << size;
        }
        VSIUnlink(cut.c_str());
    }
    EXPECT_LE(survivors, bytes.size() / step / 10) << path;
}

TEST(HeightGrid, TruncatedFilesAreRefused) {
    RasterSpec spec = relief_spec(70, 60, {7, 0.01, 0, 44, 0, -0.01});
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{},
                                               {"COMPRESS=DEFLATE"},
                                               {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"},
                                               {"COMPRESS=LZW", "PREDICTOR=3"}}) {
        spec.options = options;
        SCOPED_TRACE(options.empty() ? "plain" : options[0]);
        expect_safe_truncations(test::write_raster("whole.tif", spec), "cut.tif", 101);
    }
    std::vector<unsigned char> hgt(1201 * 1201 * 2);
    for (size_t i = 0; i < hgt.size(); i += 2)
        hgt[i] = 1, hgt[i + 1] = static_cast<unsigned char>(i / 1000);
    const std::string path = test::write_bytes("whole/N43E007.hgt", hgt);
    expect_safe_truncations(path, "cut/N43E007.hgt", 40'000);
}

TEST(HeightGrid, TruncatedRealFilesAreRefused) {
    const std::string folder = test::real_data("");
    if (!test::exists(folder + "terrain")) GTEST_SKIP() << "no shared/data beside the project";
    expect_safe_truncations(folder + "terrain/jacksboro_srtm3.tif", "cut.tif", 1024);
    expect_safe_truncations(folder + "monaco/N43E007.hgt.zip", "N43E007.hgt.zip", 16 * 1024);
}

// ------------------------------------------------------------------------------------------ ground_height

// The two triangles of a cell, written out by hand from the rule, searched one after the other.
data::GroundHeight by_triangles(const HeightGrid& grid, double col, double row) {
    for (int y = 0; y + 1 < grid.height; ++y) {
        for (int x = 0; x + 1 < grid.width; ++x) {
            const glm::ivec2 nw(x, y), ne(x + 1, y), sw(x, y + 1), se(x + 1, y + 1);
            const bool is_even = (x + y) % 2 == 0;
            const std::array<std::array<glm::ivec2, 3>, 2> triangles =
                is_even ? std::array<std::array<glm::ivec2, 3>, 2>{{{nw, se, ne}, {nw, se, sw}}}
                        : std::array<std::array<glm::ivec2, 3>, 2>{{{ne, sw, nw}, {ne, sw, se}}};
            for (const auto& t : triangles) {
                const glm::dvec2 a(t[0]), b(t[1]), c(t[2]), p(col, row);
                const auto area = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
                const double all = area(b - a, c - a);
                const double wa = area(b - p, c - p) / all, wb = area(c - p, a - p) / all,
                             wc = area(a - p, b - p) / all;
                if (std::min({wa, wb, wc}) < 0.0) continue;
                data::GroundHeight out{0.0, true};
                for (int k = 0; k < 3; ++k) {
                    const glm::ivec2 corner = t[static_cast<size_t>(k)];
                    out.height_m += (k == 0 ? wa : k == 1 ? wb : wc) * double{grid.at(corner.x, corner.y)};
                    out.valid = out.valid && !grid.void_at(corner.x, corner.y);
                }
                return out;
            }
        }
    }
    return {};
}

TEST(GroundHeight, IsTheHeightOfTheBintreeTriangles) {
    lod::Rng rng(8);
    std::vector<float> heights(7 * 5);
    for (float& h : heights)
        h = static_cast<float>(rng.between(-50, 500));
    HeightGrid grid = data::make_planar_grid(7, 5, 10.0, heights);
    grid.is_void.assign(35, 0);
    grid.is_void[grid.index(4, 2)] = 1;
    for (int i = 0; i < 5000; ++i) {
        const double col = rng.between(-0.5, 6.5), row = rng.between(-0.5, 4.5);
        const data::GroundHeight truth = by_triangles(grid, col, row),
                                 ours = data::ground_height(grid, col, row);
        ASSERT_EQ(ours.valid, truth.valid) << col << ' ' << row;
        if (truth.valid) {
            ASSERT_NEAR(ours.height_m, truth.height_m, 1e-9) << col << ' ' << row;
        }
    }
    for (int row = 0; row < 5; ++row) {
        for (int col = 0; col < 7; ++col) {
            const data::GroundHeight corner = data::ground_height(grid, col, row);
            if (corner.valid) {
                EXPECT_EQ(corner.height_m, double{grid.at(col, row)});
            }
        }
    }
    EXPECT_FALSE(data::ground_height(grid, NAN, 1).valid);
    EXPECT_FALSE(data::ground_height(grid, 6.0001, 1).valid);
    EXPECT_TRUE(data::ground_height(grid, 6.0, 4.0).valid);
}

TEST(GroundHeight, PlanarGridLiesWhereItSays) {
    const HeightGrid grid = data::make_planar_grid(3, 4, 5.0, std::vector<float>(12, 7.0f));
    EXPECT_EQ(grid.frame.world_from_sample(0, 0, 7), glm::dvec3(0, 15, 7));
    EXPECT_EQ(grid.frame.world_from_sample(2, 3, 7), glm::dvec3(10, 0, 7));
    EXPECT_EQ(grid.min_m, 7.0f);
    EXPECT_FALSE(grid.has_voids());
}

}  // namespace
