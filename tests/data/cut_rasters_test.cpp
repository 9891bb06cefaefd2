// Elevation and imagery cut at every kilobyte: refused in one line, or read as the whole where only what nobody needs
// is lost. XYZ, which does not state its length, may be smaller by whole lines, and what it still has is right.
#include <gtest/gtest.h>

#include <fstream>

#include "data/image.h"
#include "tests/data/cut_files.h"
#include "tests/data/relief.h"

namespace {

using data::HeightGrid;
using test::CutFolder;
using test::CutOutcome;

CutOutcome cut_heights(const std::string& path, size_t step_bytes = 1024) {
    const HeightGrid whole = test::read({path});
    return test::cut_down(
        path, std::filesystem::path(path).filename().string(),
        [&]() -> std::optional<std::string> {
            const auto grid = data::read_height_grid({path}, test::kHoles);
            if (!grid) return grid.message();
            EXPECT_EQ(grid->height_m, whole.height_m) << "is silently another relief";
            EXPECT_EQ(grid->is_void, whole.is_void);
            return std::nullopt;
        },
        step_bytes);
}

std::string convert(const std::string& from, const std::string& to, const char* driver,
                    const std::vector<std::string>& creation = {}) {
    char** options = nullptr;
    for (const std::string& option : creation)
        options = CSLAddString(options, option.c_str());
    GDALDatasetH source = GDALOpen(from.c_str(), GA_ReadOnly);
    GDALDatasetH copy =
        GDALCreateCopy(GDALGetDriverByName(driver), to.c_str(), source, FALSE, options, nullptr, nullptr);
    EXPECT_NE(copy, nullptr) << driver;
    if (copy) GDALClose(copy);
    GDALClose(source);
    CSLDestroy(options);
    return to;
}

std::string relief_file(int size, GDALDataType type) {
    test::RasterSpec spec = test::relief_spec(size, size, {7, 0.001, 0, 44, 0, -0.001});
    spec.type = type;
    return test::write_raster("cut_relief.tif", spec);
}

TEST(CutRasters, GeneratedHeights) {
    struct Case {
        const char *name, *driver;
        std::vector<std::string> options;
    };
    const Case cases[] = {
        {"plain.tif", "GTiff", {}},
        {"deflate.tif", "GTiff", {"COMPRESS=DEFLATE"}},
        {"tiled.tif", "GTiff", {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"}},
        {"predictor.tif", "GTiff", {"COMPRESS=LZW", "PREDICTOR=2"}},
        {"cloud.tif", "COG", {}},
        {"relief.asc", "AAIGrid", {}},
        {"relief.img", "HFA", {}},
        {"relief.bil", "EHdr", {}},
        {"relief.raw", "ENVI", {}},
        {"relief.nc", "netCDF", {"FORMAT=NC"}},
        {"relief64.nc", "netCDF", {"FORMAT=NC2"}},
        {"relief4.nc", "netCDF", {"FORMAT=NC4"}},
        {"relief.sdat", "SAGA", {}},
    };
    const std::string source = relief_file(120, GDT_Int16);
    for (const Case& item : cases) {
        SCOPED_TRACE(item.name);
        if (GDALGetDriverByName(item.driver) == nullptr) continue;
        const CutFolder folder;
        const CutOutcome outcome =
            cut_heights(convert(source, folder.file(item.name), item.driver, item.options));
        EXPECT_GE(outcome.refused, 5u);
        EXPECT_LE(outcome.read_at.size(), outcome.refused / 10);
    }
}

TEST(CutRasters, HeightsThatAreTilesOrPictures) {
    const std::string bytes = relief_file(120, GDT_UInt16), floats = relief_file(120, GDT_Float32);
    const CutFolder folder;
    EXPECT_EQ(cut_heights(convert(bytes, folder.file("relief.png"), "PNG")).read_at.size(), 0u);
    EXPECT_EQ(cut_heights(convert(floats, folder.file("relief.gpkg"), "GPKG")).read_at.size(), 0u);
}

TEST(CutRasters, LinesOfXyzAreWholeOrNotThere) {
    const CutFolder folder;
    const std::string path = convert(relief_file(40, GDT_Float32), folder.file("relief.xyz"), "XYZ");
    const HeightGrid whole = test::read({path});
    std::ifstream file(path);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    const auto read = [&](size_t length) -> std::optional<std::string> {
        const auto grid = data::read_height_grid({path}, test::kHoles);
        if (!grid) return grid.message();
        EXPECT_EQ(content[length - 1], '\n') << "a line is read that is not all there";
        EXPECT_EQ(grid->width, whole.width);
        for (int row = 0; row < grid->height; ++row) {
            for (int col = 0; col < grid->width; ++col) {
                if (grid->void_at(col, row)) continue;
                EXPECT_EQ(grid->at(col, row), whole.at(col, row)) << col << ", " << row;
            }
        }
        return std::nullopt;
    };
    test::cut_down(
        path, "relief.xyz", [&] { return read(std::filesystem::file_size(path)); }, 101);
    // Between two lines, too.
    std::ofstream(path) << content;
    const size_t middle = content.find('\n', content.size() / 2) + 1;
    std::filesystem::resize_file(path, middle);
    EXPECT_FALSE(read(middle)) << "cut between two lines it is a smaller file, and valid";
}

TEST(CutRasters, RealHeights) {
    if (!test::exists(test::real_data("terrain"))) GTEST_SKIP() << "no shared/data beside the project";
    for (const char* name :
         {"terrain/jacksboro_srtm3.tif", "terrain/sfdem_declared_nodata.tif", "somerset/somerset_dtm_2m.tif",
          "terrain/dem_gaps.tif", "monaco/N43E007.hgt.zip"}) {
        SCOPED_TRACE(name);
        const CutFolder folder;
        const CutOutcome outcome = cut_heights(folder.copy(test::real_data(name)));
        EXPECT_GT(outcome.refused, 80u);
        EXPECT_LE(outcome.read_at.size(), outcome.refused / 10);
    }
}

TEST(CutRasters, RealSrtmTileUnpackedAndInGzip) {
    const std::string zip = test::real_data("monaco/N43E007.hgt.zip");
    if (!test::exists(zip)) GTEST_SKIP() << "no shared/data beside the project";
    const std::vector<unsigned char> bytes = test::file_bytes("/vsizip/" + zip + "/N43E007.hgt");
    const CutFolder folder;
    const std::string tile = folder.file("N43E007.hgt"), packed = tile + ".gz";
    for (const std::string& path : {tile, "/vsigzip/" + packed}) {
        VSILFILE* file = VSIFOpenL(path.c_str(), "wb");
        ASSERT_EQ(VSIFWriteL(bytes.data(), 1, bytes.size(), file), bytes.size());
        VSIFCloseL(file);
    }
    EXPECT_TRUE(cut_heights(tile).read_at.empty());
    EXPECT_TRUE(cut_heights(packed, 4096).read_at.empty());
}

CutOutcome cut_imagery(const std::string& path, const HeightGrid& grid, int max_size_px, size_t step_bytes) {
    const auto whole = data::read_imagery({path}, grid, max_size_px);
    EXPECT_TRUE(whole) << whole.message();
    if (!whole) return {};
    return test::cut_down(
        path, std::filesystem::path(path).filename().string(),
        [&]() -> std::optional<std::string> {
            const auto image = data::read_imagery({path}, grid, max_size_px);
            if (!image) return image.message();
            EXPECT_EQ(image->rgba, whole->rgba) << "is silently another picture";
            return std::nullopt;
        },
        step_bytes);
}

TEST(CutRasters, GeneratedImagery) {
    const std::string relief = relief_file(160, GDT_Int16);
    const HeightGrid grid = test::read({relief});
    test::RasterSpec spec{.width = 160, .height = 160, .bands = 3, .type = GDT_Byte};
    spec.geo_transform = {7, 0.001, 0, 44, 0, -0.001};
    for (int band = 0; band < 3; ++band) {
        for (int i = 0; i < 160 * 160; ++i)
            spec.values.push_back((i * (i + 17 * band) % 1009 * 31) % 251);
    }
    const std::string source = test::write_raster("cut_picture.tif", spec);
    struct Case {
        const char *name, *driver;
        std::vector<std::string> options;
    };
    const Case cases[] = {
        {"plain.jpg", "JPEG", {}},    {"progressive.jpg", "JPEG", {"PROGRESSIVE=ON"}},
        {"picture.png", "PNG", {}},   {"picture.tif", "GTiff", {"COMPRESS=JPEG", "PHOTOMETRIC=YCBCR"}},
        {"picture.bmp", "BMP", {}},   {"picture.jp2", "JP2OpenJPEG", {}},
        {"picture.webp", "WEBP", {}},
    };
    for (const Case& item : cases) {
        SCOPED_TRACE(item.name);
        if (GDALGetDriverByName(item.driver) == nullptr) continue;
        const CutFolder folder;
        const CutOutcome outcome =
            cut_imagery(convert(source, folder.file(item.name), item.driver, item.options), grid, 160, 1024);
        EXPECT_GE(outcome.refused, 5u);
        EXPECT_LE(outcome.read_at.size(), 1u);
    }
}

TEST(CutRasters, RealImagery) {
    const std::string dem = test::real_data("somerset/somerset_dtm_2m.tif");
    if (!test::exists(dem)) GTEST_SKIP() << "no shared/data beside the project";
    const CutFolder folder;
    const std::string path = folder.copy(test::real_data("somerset/somerset_rgb_2m.tif"));
    EXPECT_TRUE(cut_imagery(path, test::read({dem}), 64, 16 * 1024).read_at.empty());
}

}  // namespace
