// No crack: before a magenta background, no background pixel where the eye must meet ground, over thousands of random
// views of fronts interrupted anywhere: ROAM's, and those of all methods that claim so.
#include <fstream>

#include "terrain/rivals/rivals.h"
#include "terrain/roam_front.h"
#include "tests/sim/crack_rig.h"

namespace {

using sim_test::CrackTally;
using sim_test::CrackTrial;
using terrain::Rival;

const std::string kJacksboro = std::string(HARRIER_SOURCE_DIR) + "/data/samples/jacksboro.tif";
const std::string kBigTujunga =
    std::string(HARRIER_SOURCE_DIR) + "/../shared/data/terrain/srtm_bigtujunga30m_utm11.tif";

void expect_no_roam_cracks(const std::string& path, const CrackTrial& trial, double glide_s, int batch = 0) {
    const auto grid = data::read_height_grid({path}, {});
    ASSERT_TRUE(grid) << grid.message();
    terrain::RoamFront front(terrain::make_diamond_table(*grid, 2),
                             {.tolerance_px = 1.0,
                              .reserve_triangles = 3 * sim_test::CrackRig::kMostTriangles,
                              .glide_s = glide_s,
                              .batch = batch});
    CrackTally sum;
    expect_no_cracks(*grid, front, trial, sum);
    if (testing::Test::IsSkipped()) return;
    EXPECT_GT(sum.largest_jump_px, 0.0) << "something should move";
}

TEST(Cracks, NoneOverJacksboro) {
    expect_no_roam_cracks(kJacksboro, {1800, 21}, 0.0);
}
TEST(Cracks, NoneWhileVerticesGlide) {
    expect_no_roam_cracks(kJacksboro, {1800, 23}, 0.4);
}

TEST(Cracks, NoneOverBigTujunga) {
    if (!std::ifstream(kBigTujunga)) GTEST_SKIP() << kBigTujunga << " is not on this machine";
    expect_no_roam_cracks(kBigTujunga, {1800, 22}, 0.0);
}
TEST(Cracks, NoneOverBigTujungaWhileVerticesGlide) {
    if (!std::ifstream(kBigTujunga)) GTEST_SKIP() << kBigTujunga << " is not on this machine";
    expect_no_roam_cracks(kBigTujunga, {1800, 24}, 0.4);
}

/// Leaves drawn as 4^k triangles.
class BatchCracks : public testing::TestWithParam<int> {};

TEST_P(BatchCracks, None) {
    expect_no_roam_cracks(kJacksboro, {1800, 25}, 0.0, GetParam());
    if (std::ifstream(kBigTujunga)) expect_no_roam_cracks(kBigTujunga, {1800, 26}, 0.0, GetParam());
}

INSTANTIATE_TEST_SUITE_P(K, BatchCracks, testing::Values(1, 2, 3));

/// 3,600 pictures of each rival, half of them in either test.
class RivalCracks : public testing::TestWithParam<std::tuple<Rival, uint64_t>> {};

TEST_P(RivalCracks, None) {
    const auto [kind, seed] = GetParam();
    const auto grid = data::read_height_grid({kJacksboro}, {});
    ASSERT_TRUE(grid) << grid.message();
    const terrain::DiamondTable table = terrain::make_diamond_table(*grid, 2);
    const auto front = terrain::make_rival(kind, *grid, table, {.tolerance_px = 1.0, .threads = 2});
    CrackTally sum;
    expect_no_cracks(*grid, *front, {1800, seed}, sum);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, RivalCracks,
    testing::Combine(testing::Values(Rival::kChunkedQuadtree, Rival::kGeoMipmap, Rival::kVipmBlocks,
                                     Rival::kVdpm, Rival::kRoamMergeOnly),
                     testing::Values(31u, 32u)),
    [](const auto& trial) {
        return std::string(terrain::kRivals[static_cast<size_t>(std::get<0>(trial.param))].name) + "_" +
               std::to_string(std::get<1>(trial.param));
    });

}  // namespace
