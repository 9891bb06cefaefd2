// Breadths of parts by hand, and how errors count in them.
#include "lod/progressive/part_breadth.h"

#include <gtest/gtest.h>

#include "lod/progressive/build_hierarchy.h"
#include "tests/lod/mesh_shapes.h"

namespace {

lod::VertexHierarchy built(const lod::SurfaceMesh& mesh) {
    lod::MeshReport report;
    auto hierarchy = lod::build_hierarchy(mesh, {}, report);
    EXPECT_TRUE(hierarchy) << hierarchy.message();
    return std::move(*hierarchy);
}

/// A strip of 8 x 0.5 beside a square of 3 x 3, both flat.
lod::SurfaceMesh strip_and_square() {
    return lod_test::soup(
        {{0, 0, 0}, {8, 0, 0}, {8, 0.5, 0}, {0, 0.5, 0}, {0, 5, 1}, {3, 5, 1}, {3, 8, 1}, {0, 8, 1}},
        {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
}

TEST(PartBreadth, StripsAndBoxesByHand) {
    const lod::VertexHierarchy flat = built(strip_and_square());
    const std::vector<double> breadths = lod::breadths_of_leaves(flat);
    ASSERT_EQ(breadths.size(), 8u);
    for (size_t leaf = 0; leaf < breadths.size(); ++leaf) {
        const bool is_strip = flat.position[leaf].z == 0.0f;
        EXPECT_NEAR(breadths[leaf], is_strip ? 2.0 * 4.0 / 17.0 : 2.0 * 9.0 / 12.0, 1e-12);
    }
    for (double breadth : lod::breadths_of_leaves(built(lod_test::box(3))))  // 2 x 2 x 2, closed
        EXPECT_NEAR(breadth, 4.0 * 8.0 / 24.0, 1e-6);
}

TEST(PartBreadth, AnErrorCountsAsMuchAsItEats) {
    EXPECT_EQ(lod::seen_error_m(0.0, 1.0), 0.0);
    EXPECT_EQ(lod::seen_error_m(0.0, 0.0), 0.0);
    EXPECT_EQ(lod::seen_error_m(0.25, 1.0), 2.0);
    EXPECT_EQ(lod::seen_error_m(3.0, 1.0), 24.0);
    EXPECT_EQ(lod::seen_error_m(0.5, 0.0), 4.0);
    EXPECT_DOUBLE_EQ(lod::seen_error_m(0.125, 1.0), 0.125 * (1.0 + 7.0 / 4.0));
    double last = 0.0;
    for (double error_m = 1e-4; error_m < 0.4; error_m += 1e-4) {
        const double seen_m = lod::seen_error_m(error_m, 1.0);
        EXPECT_GE(seen_m, error_m);
        EXPECT_GT(seen_m, last);
        last = seen_m;
    }
}

}  // namespace
