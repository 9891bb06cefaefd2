// The committed samples are what their generators and their source say.
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "data/footprints.h"
#include "data/generated_altimeter.h"
#include "data/generated_town.h"
#include "data/ground_height.h"
#include "data/height_grid.h"

namespace data {
namespace {

const std::string kSamples = HARRIER_SOURCE_DIR "/data/samples/";

std::vector<int16_t> pixels_of(const std::string& path) {
    GDALAllRegister();
    const GDALDatasetUniquePtr file(GDALDataset::Open(path.c_str()));
    if (!file) return {};
    std::vector<int16_t> pixels(static_cast<size_t>(file->GetRasterXSize()) *
                                static_cast<size_t>(file->GetRasterYSize()));
    const CPLErr error = file->GetRasterBand(1)->RasterIO(
        GF_Read, 0, 0, file->GetRasterXSize(), file->GetRasterYSize(), pixels.data(), file->GetRasterXSize(),
        file->GetRasterYSize(), GDT_Int16, 0, 0);
    return error == CE_None ? pixels : std::vector<int16_t>{};
}

TEST(Samples, TheReliefIsTheSharedOnePixelForPixel) {
    const std::string shared = HARRIER_SOURCE_DIR "/../shared/data/terrain/jacksboro_srtm3.tif";
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << shared << " is not here";
    const std::vector<int16_t> ours = pixels_of(kSamples + "jacksboro.tif");
    EXPECT_EQ(ours.size(), 403u * 344u);
    EXPECT_EQ(ours, pixels_of(shared));
}

TEST(Samples, TheTownIsReadWholeAndStandsOnTheRelief) {
    const lod::Result<HeightGrid> relief = read_height_grid({kSamples + "jacksboro.tif"}, {});
    ASSERT_TRUE(relief) << relief.message();
    const lod::Result<Footprints> town =
        read_footprints(kSamples + "town.geojson", relief->frame.world(), {});
    ASSERT_TRUE(town) << town.message();
    const std::vector<TownBuilding> generated = generate_town({});
    ASSERT_EQ(town->buildings.size(), generated.size());
    EXPECT_EQ(town->stats.with_height, generated.size());
    for (const Footprint& building : town->buildings) {
        for (const glm::dvec2& site : building.rings[0]) {
            const glm::dvec2 at = relief->frame.grid_from_site({site.x, site.y, 0.0});
            const GroundHeight ground = ground_height(*relief, at.x, at.y);
            ASSERT_TRUE(ground.valid);
            ASSERT_LT(ground.height_m, 420.0) << "on the valley floor";
        }
    }
}

}  // namespace
}  // namespace data
