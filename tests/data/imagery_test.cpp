#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "data/image.h"
#include "tests/data/raster_writer.h"

namespace {

using data::HeightGrid;
using data::Image;
using test::RasterSpec;

constexpr int kLarge = 4096;

// A grid with a place and flat ground.
HeightGrid flat_grid(int width, int height, const std::array<double, 6>& g, const std::string& crs) {
    HeightGrid grid;
    grid.width = width;
    grid.height = height;
    grid.height_m.assign(static_cast<size_t>(width) * static_cast<size_t>(height), 0.0f);
    const auto frame = data::GroundFrame::make(g, crs, width, height);
    EXPECT_TRUE(frame) << frame.message();
    if (frame) grid.frame = *frame;
    return grid;
}

// A picture whose red tells x and whose green tells y; blue is given.
RasterSpec picture(int width, int height, const std::array<double, 6>& g,
                   const std::function<glm::dvec3(glm::dvec2)>& colour) {
    RasterSpec spec{.width = width,
                    .height = height,
                    .bands = 3,
                    .type = GDT_Byte,
                    .geo_transform = g,
                    .options = {"PHOTOMETRIC=RGB"}};
    for (int band = 0; band < 3; ++band) {
        for (int row = 0; row < height; ++row) {
            for (int col = 0; col < width; ++col) {
                const glm::dvec2 at(g[0] + (col + 0.5) * g[1], g[3] + (row + 0.5) * g[5]);
                spec.values.push_back(std::round(colour(at)[band]));
            }
        }
    }
    return spec;
}

glm::dvec3 colour_of_site(glm::dvec2 site) {
    return {128 + 100 * std::sin(40 * site.x), 128 + 100 * std::cos(40 * site.y), 77};
}

Image read(const std::vector<std::string>& paths, const HeightGrid& grid, int max_size_px = kLarge) {
    auto image = data::read_imagery(paths, grid, max_size_px);
    EXPECT_TRUE(image) << image.message();
    return image ? std::move(*image) : Image{1, 1, {0, 0, 0, 0}};
}

glm::ivec4 pixel(const Image& image, int col, int row) {
    const size_t i =
        4 * (static_cast<size_t>(row) * static_cast<size_t>(image.width) + static_cast<size_t>(col));
    return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2], image.rgba[i + 3]};
}

data::SitePoint site_of(const Image& image, const HeightGrid& grid, int col, int row) {
    return grid.frame.site_from_grid((col + 0.5) * grid.width / image.width - 0.5,
                                     (row + 0.5) * grid.height / image.height - 0.5);
}

// Every covered pixel shows the colour its site has; @returns the share of covered pixels.
double expect_colours(const Image& image, const HeightGrid& grid, double tolerance) {
    size_t covered = 0;
    for (int row = 0; row < image.height; ++row) {
        for (int col = 0; col < image.width; ++col) {
            const glm::ivec4 found = pixel(image, col, row);
            if (found.w == 0) continue;
            ++covered;
            const data::SitePoint site = site_of(image, grid, col, row);
            const glm::dvec3 expected = colour_of_site({site.x, site.y});
            const glm::dvec3 off = glm::abs(glm::dvec3(found) - expected);
            if (std::max({off.x, off.y, off.z}) > tolerance) {
                ADD_FAILURE() << "pixel " << col << ' ' << row << " is " << off.x << ' ' << off.y << ' '
                              << off.z << " off";
                return 0.0;
            }
        }
    }
    return double(covered) / (double(image.width) * image.height);
}

TEST(Imagery, GeographicPictureOnUtmTerrain) {
    const HeightGrid grid = flat_grid(300, 200, {350000, 30, 0, 4850000, 0, -30}, "EPSG:32632");
    const std::string path = test::write_raster(
        "wide.tif", picture(600, 500, {7.1, 0.0003, 0, 43.82, 0, -0.0003}, colour_of_site));
    const Image image = read({path}, grid);
    EXPECT_GT(image.width, 350);  // as fine as the source's finer axis: 24 m of 30 m cells
    EXPECT_LT(image.width, 420);
    EXPECT_EQ(expect_colours(image, grid, 3.0), 1.0);
    const Image small = read({path}, grid, 100);
    EXPECT_EQ(small.width, 100);
    EXPECT_EQ(small.height, 67);
    EXPECT_EQ(expect_colours(small, grid, 12.0), 1.0);  // averaged over larger pixels
}

TEST(Imagery, ProjectedPictureOnGeographicTerrainPartly) {
    const HeightGrid grid = flat_grid(200, 150, {7.0, 0.001, 0, 43.9, 0, -0.001}, "EPSG:4326");
    RasterSpec spec = picture(250, 220, {342000, 40, 0, 4856000, 0, -40}, colour_of_site);
    spec.crs = "EPSG:32632";
    const auto frame = data::GroundFrame::make(spec.geo_transform, spec.crs, spec.width, spec.height);
    for (int k = 0; k < spec.width * spec.height; ++k) {
        const data::SitePoint site = frame->site_from_grid(k % spec.width, k / spec.width);
        const glm::dvec3 colour = glm::round(colour_of_site({site.x, site.y}));
        for (int c = 0; c < 3; ++c)
            spec.values[static_cast<size_t>(c * spec.width * spec.height + k)] = colour[c];
    }
    const Image image = read({test::write_raster("utm_rgb.tif", spec)}, grid);
    const double share = expect_colours(image, grid, 5.0);
    const double source_km2 = 10.0 * 8.8, grid_km2 = 0.2 * 80.4 * 0.15 * 111.1;
    EXPECT_NEAR(share, source_km2 / grid_km2, 0.02);
}

TEST(Imagery, AWorldPictureCoversTheAntimeridian) {
    const HeightGrid grid = flat_grid(100, 60, {179.0, 0.02, 0, -16, 0, -0.02}, "EPSG:4326");
    const auto hue = [](glm::dvec2 site) {
        return glm::dvec3(128 + 100 * std::sin(site.x * 3.14159265 / 180), 100 + site.y, 9);
    };
    const Image image =
        read({test::write_raster("world.tif", picture(1440, 720, {-180, 0.25, 0, 90, 0, -0.25}, hue))}, grid);
    for (int row = 0; row < image.height; ++row) {
        for (int col = 0; col < image.width; ++col) {
            const data::SitePoint site = site_of(image, grid, col, row);
            const glm::ivec4 found = pixel(image, col, row);
            ASSERT_EQ(found.w, 255) << col;
            ASSERT_NEAR(found.x, hue({site.x, site.y}).x, 2.0) << col;
            ASSERT_NEAR(found.y, hue({site.x, site.y}).y, 2.0) << col;
        }
    }
}

TEST(Imagery, TheFirstListedWins) {
    const HeightGrid grid = flat_grid(40, 30, {0, 1, 0, 30, 0, -1}, "");
    const auto solid = [](const char* name, const std::array<double, 6>& g, glm::dvec3 colour) {
        RasterSpec spec = picture(20, 20, g, [&](glm::dvec2) { return colour; });
        spec.crs.clear();
        return test::write_raster(name, spec);
    };
    const std::string red = solid("red.tif", {0, 1, 0, 30, 0, -1}, {250, 0, 0});
    const std::string blue = solid("blue.tif", {10, 1, 0, 30, 0, -1}, {0, 0, 250});
    const Image image = read({red, blue}, grid);
    ASSERT_EQ(image.width, 40);
    EXPECT_EQ(pixel(image, 0, 0), glm::ivec4(250, 0, 0, 255));
    EXPECT_EQ(pixel(image, 19, 19), glm::ivec4(250, 0, 0, 255));
    EXPECT_EQ(pixel(image, 20, 19), glm::ivec4(0, 0, 250, 255));
    EXPECT_EQ(pixel(image, 30, 0).w, 0);
    EXPECT_EQ(pixel(image, 0, 20).w, 0);
    EXPECT_EQ(pixel(read({blue, red}, grid), 15, 5), glm::ivec4(0, 0, 250, 255));
}

TEST(Imagery, PixelsFinerOrCoarserThanCellsKeepTheirPlace) {
    const HeightGrid grid = flat_grid(4, 2, {0, 8, 0, 16, 0, -8}, "");
    RasterSpec spec = picture(16, 8, {0, 2, 0, 16, 0, -2},
                              [](glm::dvec2 at) { return glm::dvec3(7 * at.x, 15 * at.y, 0); });
    spec.crs.clear();
    const std::string path = test::write_raster("fine_rgb.tif", spec);
    const Image same = read({path}, grid);
    ASSERT_EQ(same.width, 16);
    for (int k = 0; k < 128; ++k) {
        ASSERT_EQ(double(pixel(same, k % 16, k / 16).x), spec.values[static_cast<size_t>(k)]);
        ASSERT_EQ(double(pixel(same, k % 16, k / 16).y), spec.values[static_cast<size_t>(128 + k)]);
    }
    const Image averaged = read({path}, grid, 4);
    ASSERT_EQ(averaged.width, 4);
    for (int col = 0; col < 4; ++col)
        EXPECT_NEAR(pixel(averaged, col, 1).x, 7 * (8 * col + 4), 1);
    EXPECT_NEAR(pixel(averaged, 0, 0).y, 15 * 12, 1);
}

/// One band of four by two pixels of one unit, without a CRS.
RasterSpec eight_pixels(const std::vector<double>& values, GDALDataType type) {
    return {.width = 4,
            .height = 2,
            .values = values,
            .type = type,
            .geo_transform = {0, 1, 0, 2, 0, -1},
            .crs = ""};
}

TEST(Imagery, GreyAlphaNodataAndDeepBands) {
    const HeightGrid grid = flat_grid(4, 2, {0, 1, 0, 2, 0, -1}, "");
    RasterSpec grey = eight_pixels({0, 10, 20, 30, 40, 50, 60, 70}, GDT_Byte);
    EXPECT_EQ(pixel(read({test::write_raster("grey.tif", grey)}, grid), 3, 1), glm::ivec4(70, 70, 70, 255));
    grey.has_nodata = true;
    grey.nodata = 70;
    EXPECT_EQ(pixel(read({test::write_raster("grey2.tif", grey)}, grid), 3, 1).w, 0);
    EXPECT_EQ(pixel(read({"/vsimem/grey2.tif"}, grid), 0, 0), glm::ivec4(0, 0, 0, 255));
    RasterSpec deep = eight_pixels({1000, 1000, 2000, 2000, 3000, 3000, 4000, 5000}, GDT_UInt16);
    const Image stretched = read({test::write_raster("deep.tif", deep)}, grid);
    EXPECT_EQ(pixel(stretched, 0, 0).x, 0);
    EXPECT_EQ(pixel(stretched, 3, 1).x, 255);
    EXPECT_NEAR(pixel(stretched, 0, 1).x, 128, 1);
    RasterSpec dark =
        picture(4, 2, {0, 1, 0, 2, 0, -1}, [](glm::dvec2 at) { return glm::dvec3(0, at.x > 2 ? 50 : 0, 0); });
    dark.crs.clear();
    dark.has_nodata = true;  // 0: of a pixel only where all three bands have it
    const Image dark_image = read({test::write_raster("dark.tif", dark)}, grid);
    EXPECT_EQ(pixel(dark_image, 0, 0).w, 0);
    EXPECT_EQ(pixel(dark_image, 3, 0), glm::ivec4(0, 50, 0, 255));
    RasterSpec alpha = picture(4, 2, {0, 1, 0, 2, 0, -1}, [](glm::dvec2) { return glm::dvec3(9, 8, 7); });
    alpha.bands = 4;
    alpha.crs.clear();
    alpha.options.push_back("ALPHA=YES");
    for (int k = 0; k < 8; ++k)
        alpha.values.push_back(k % 2 ? 255 : 0);
    const Image holed = read({test::write_raster("alpha.tif", alpha)}, grid);
    EXPECT_EQ(pixel(holed, 0, 0).w, 0);
    EXPECT_EQ(pixel(holed, 1, 0), glm::ivec4(9, 8, 7, 255));
}

TEST(Imagery, PalettesAreLookedUp) {
    const HeightGrid grid = flat_grid(4, 2, {0, 1, 0, 2, 0, -1}, "");
    RasterSpec spec = eight_pixels({0, 1, 2, 0, 1, 2, 0, 1}, GDT_Byte);
    const std::string path = test::write_raster("palette.tif", spec);
    GDALDatasetH dataset = GDALOpen(path.c_str(), GA_Update);
    GDALColorTableH table = GDALCreateColorTable(GPI_RGB);
    const GDALColorEntry entries[] = {{255, 0, 0, 255}, {0, 200, 0, 255}, {0, 0, 100, 255}};
    for (int i = 0; i < 3; ++i)
        GDALSetColorEntry(table, i, &entries[i]);
    EXPECT_EQ(GDALSetRasterColorTable(GDALGetRasterBand(dataset, 1), table), CE_None);
    GDALDestroyColorTable(table);
    GDALClose(dataset);
    const Image image = read({path}, grid);
    EXPECT_EQ(pixel(image, 0, 0), glm::ivec4(255, 0, 0, 255));
    EXPECT_EQ(pixel(image, 1, 0), glm::ivec4(0, 200, 0, 255));
    EXPECT_EQ(pixel(image, 1, 1), glm::ivec4(0, 0, 100, 255));
}

TEST(Imagery, SomersetOrthophotoLiesOnItsTerrain) {
    const std::string dem = test::real_data("somerset/somerset_dtm_2m.tif"),
                      ortho = test::real_data("somerset/somerset_rgb_2m.tif");
    if (!test::exists(dem)) GTEST_SKIP() << "no shared/data beside the project";
    const auto grid = data::read_height_grid({dem}, {});
    ASSERT_TRUE(grid) << grid.message();
    const Image image = read({ortho}, *grid);
    ASSERT_EQ(image.width, 900);
    ASSERT_EQ(image.height, 900);
    // The photo starts 0.944758 m, or 0.47238 of its pixels, further north.
    GDALDatasetH dataset = GDALOpen(ortho.c_str(), GA_ReadOnly);
    double total = 0.0;
    int count = 0;
    for (int row = 0; row < 899; row += 13) {  // the last one has no lower neighbour
        for (int col = 5; col < 895; col += 17) {
            const glm::ivec4 found = pixel(image, col, row);
            ASSERT_EQ(found.w, 255) << row;
            const double share = 0.47238;
            for (int c = 0; c < 3; ++c) {
                unsigned char two[2];
                ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, c + 1), GF_Read, col, row, 1, 2, two, 1, 2,
                                       GDT_Byte, 0, 0),
                          CE_None);
                const double expected = two[0] + share * (two[1] - two[0]);
                total += std::abs(found[c] - expected);
                ASSERT_NEAR(found[c], expected, 3.0) << col << ' ' << row;
                ++count;
            }
        }
    }
    GDALClose(dataset);
    EXPECT_GT(count, 5000);
    EXPECT_LT(total / count, 0.6);
}

TEST(Imagery, RefusesWithOneLine) {
    const HeightGrid grid = flat_grid(40, 30, {7.0, 0.01, 0, 44, 0, -0.01}, "EPSG:4326");
    const auto expect = [&](const std::vector<std::string>& paths, const std::vector<std::string>& parts) {
        const auto image = data::read_imagery(paths, grid, 100);
        ASSERT_FALSE(image);
        for (const std::string& part : parts)
            EXPECT_NE(image.message().find(part), std::string::npos) << image.message();
        EXPECT_EQ(image.message().find('\n'), std::string::npos) << image.message();
    };
    expect({}, {"expected"});
    expect({"/nowhere.png"}, {"imagery '/nowhere.png'", "No such file", "expected"});
    RasterSpec spec = picture(20, 20, {12, 0.01, 0, 50, 0, -0.01}, colour_of_site);
    expect({test::write_raster("far.tif", spec)}, {"far.tif", "12..12.2, 49.8..50", "7..7.4, 43.7..44"});
    spec.crs.clear();
    expect({test::write_raster("plain.tif", spec)}, {"no CRS"});
    const std::string whole = test::write_raster(
        "whole_rgb.tif", picture(200, 200, {7.1, 0.001, 0, 43.95, 0, -0.001}, colour_of_site));
    const std::vector<unsigned char> bytes = test::file_bytes(whole);
    for (size_t size = 0; size < bytes.size() - 200; size += 1024) {
        expect({test::write_bytes("cut_rgb.tif",
                                  {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)})},
               {"cut_rgb.tif", "expected"});
    }
}

}  // namespace
