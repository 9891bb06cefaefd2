// Sierpinski order in the index list as it is drawn after a flight: vertices fetched a triangle, bytes a triangle.
#include <gtest/gtest.h>

#include <set>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/bench/vertex_cache.h"
#include "tests/terrain/drawn_mesh.h"
#include "tests/terrain/test_relief.h"

namespace {

struct Limits {
    int batch;
    double fifo16, fifo32, bytes;
};

class IndexOrder : public testing::TestWithParam<Limits> {};

TEST_P(IndexOrder, KeepsVerticesInTheCache) {
    const Limits& limits = GetParam();
    const data::HeightGrid grid = terrain_test::fractal_grid(1025, 1025, 10.0, 900.0, 1);
    terrain::RoamFront front(terrain::make_diamond_table(grid, 2),
                             {.tolerance_px = 1.0, .reserve_triangles = 200'000, .batch = limits.batch});
    lod::Front* fronts[] = {&front};
    front.place(front.pool_need());
    terrain_test::PoolTwin pool;
    lod::DrawList list;
    for (int frame = 0; frame < 60; ++frame) {
        const double s = 100.0 / 60.0 * frame;
        const lod::View view = terrain_test::level_view(
            {2000.0 + 0.6 * s, 2000.0 + 0.8 * s, double(grid.max_m) + 150.0}, 0.6435, -0.15);
        front.begin_frame({&view, 1}, 0.0);
        lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(UINT64_MAX));
        list.clear();
        front.emit(view, list);
        pool.apply(list);
    }
    std::vector<uint32_t> listed, drawn;
    for (const lod::DrawItem& item : list.items) {
        const auto first = pool.indices.begin() + item.first_index;
        listed.insert(listed.end(), first, first + item.index_count);
    }
    for (size_t i = 0; i < listed.size(); i += 3) {
        if (listed[i] != listed[i + 1]) drawn.insert(drawn.end(), &listed[i], &listed[i] + 3);
    }
    ASSERT_EQ(drawn.size(), 3 * front.emitted_triangles());
    const std::set<uint32_t> vertices(drawn.begin(), drawn.end());
    const double triangles = double(drawn.size()) / 3.0;
    const double fifo16 = bench::fifo_misses_a_triangle(listed, 16);
    const double fifo32 = bench::fifo_misses_a_triangle(listed, 32);
    const double bytes =
        (double(vertices.size()) * sizeof(lod::Vertex) + double(listed.size()) * sizeof(uint32_t)) /
        triangles;
    std::printf(
        "k %d: %.0f triangles, %.3f / %.3f vertices fetched a triangle with 16 / 32 kept, %.3f there are, "
        "%.1f bytes a triangle\n",
        limits.batch, triangles, fifo16, fifo32, double(vertices.size()) / triangles, bytes);
    EXPECT_LE(fifo16, limits.fifo16);
    EXPECT_LE(fifo32, limits.fifo32);
    EXPECT_LE(bytes, limits.bytes);
}

INSTANTIATE_TEST_SUITE_P(K, IndexOrder,
                         testing::Values(Limits{0, 0.95, 0.8, 32.0}, Limits{1, 0.95, 0.8, 32.0},
                                         Limits{2, 0.95, 0.8, 32.0}, Limits{3, 0.95, 0.8, 32.0}),
                         [](const auto& limits) { return "k" + std::to_string(limits.param.batch); });

}  // namespace
