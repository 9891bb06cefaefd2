// What MeshFront writes into the pool, seen from the pool: the drawn triangles are the cut's, little is written, nothing
// jumps by more than told.
#include <gtest/gtest.h>

#include <cmath>

#include "lod/progressive/mesh_front.h"
#include "lod/scheduler.h"
#include "tests/lod/allocations.h"
#include "tests/lod/mesh_distance.h"
#include "tests/lod/plain_hierarchy.h"

namespace {

using lod::View;

/// The geometry pool as a renderer keeps it.
struct Pool {
    std::vector<lod::Vertex> vertices;
    std::vector<uint32_t> indices;
    uint64_t index_bytes = 0, vertex_bytes = 0;  ///< of the last frame

    explicit Pool(lod::MeshFront& front) {
        lod::PoolRegion region = front.pool_need();
        region.first_vertex = 7;
        region.first_index = 30;
        vertices.resize(region.first_vertex + region.vertex_capacity);
        indices.resize(region.first_index + region.index_capacity);
        front.place(region);
    }
    void take(const lod::DrawList& list) {
        index_bytes = vertex_bytes = 0;
        for (const lod::VertexWrite& write : list.vertex_writes) {
            ASSERT_LE(write.first_vertex + write.vertices.size(), vertices.size());
            std::copy(write.vertices.begin(), write.vertices.end(), vertices.begin() + write.first_vertex);
            vertex_bytes += write.vertices.size_bytes();
        }
        for (const lod::IndexWrite& write : list.index_writes) {
            ASSERT_LE(write.first_index + write.indices.size(), indices.size());
            std::copy(write.indices.begin(), write.indices.end(), indices.begin() + write.first_index);
            index_bytes += write.indices.size_bytes();
        }
    }
    lod_test::Soup drawn(const lod::DrawList& list) const {
        lod_test::Soup soup;
        for (const lod::DrawItem& item : list.items) {
            for (uint32_t i = 0; i < item.index_count; i += 3) {
                soup.emplace_back();
                for (uint32_t k = 0; k < 3; ++k) {
                    const uint32_t index = indices[item.first_index + i + k];
                    soup.back()[k] =
                        lod::position_of(vertices[static_cast<size_t>(item.base_vertex) + index]);
                }
            }
        }
        return soup;
    }
};

const lod_test::PlainMesh& source() {
    static const lod_test::PlainMesh mesh =
        lod_test::joined(lod_test::bumpy_sheet(30, 5), lod_test::bumpy_ring(44, 18, 6));
    return mesh;
}

struct Scene {
    explicit Scene(double glide_s)
        : front(lod::Module::kInstruments, meshes(), std::vector<lod::MeshPlacement>(1), options(glide_s)),
          pool(front) {}

    static std::vector<lod::ProgressiveMesh> meshes() {
        std::vector<lod::ProgressiveMesh> made;
        made.push_back(lod::make_progressive_mesh(lod_test::make_plain_history(source()).hierarchy));
        return made;
    }
    static lod::MeshOptions options(double glide_s) {
        lod::MeshOptions made;
        made.glide_s = glide_s;
        return made;
    }
    void fly(const View& view, double time_s, uint64_t operations) {
        lod::Front* fronts[] = {&front};
        list.clear();
        front.begin_frame({&view, 1}, time_s);
        lod::schedule(fronts, {}, lod::operation_limit(operations));
        front.emit(view, list);
        pool.take(list);
    }

    lod::MeshFront front;
    Pool pool;
    lod::DrawList list;
};

/// Comes nearer, then goes away again.
View approach(int frame) {
    View optics;
    optics.width_px = 1280;
    optics.height_px = 720;
    const double away = 60.0 - 50.0 * std::sin(frame * 0.02);
    return lod::look_at({2.0, -away, 0.4 * away}, {2.0, 0.2, 0.0}, {0.0, 0.0, 1.0}, optics);
}

TEST(MeshSheet, ThePoolHoldsTheCutAndLittleIsWritten) {
    Scene scene(0.0);
    uint64_t written = 0, whole = 0;
    for (int frame = 0; frame < 200; ++frame) {
        // Nearest and farthest in turn, a few operations at a time: most pages are touched by one of them alone.
        scene.fly(approach(frame % 100 < 50 ? 78 : 235), frame / 60.0, frame == 0 ? UINT64_MAX : 5);
        lod_test::Soup expected = lod_test::drawn(scene.front.body(0).cut());
        lod_test::Soup found = scene.pool.drawn(scene.list);
        ASSERT_EQ(scene.front.emitted_triangles(), found.size());
        const auto before = [](const auto& a, const auto& b) {
            for (size_t i = 0; i < 9; ++i) {
                const double x = a[i / 3][static_cast<int>(i % 3)], y = b[i / 3][static_cast<int>(i % 3)];
                if (x != y) return x < y;
            }
            return false;
        };
        std::sort(expected.begin(), expected.end(), before);
        std::sort(found.begin(), found.end(), before);
        ASSERT_EQ(expected, found) << "frame " << frame;
        ASSERT_EQ(scene.front.validate(), "");
        if (frame == 0) continue;
        written += scene.pool.index_bytes;
        whole += 12 * found.size();
    }
    EXPECT_GT(scene.front.operations()[lod::OperationKind::kEcol], 100u);
    EXPECT_GT(scene.front.operations()[lod::OperationKind::kVsplit], 100u);
    EXPECT_LT(written, whole / 4) << "only what changed is written";
}

TEST(MeshSheet, StandingStillWritesNothingAndAllocatesNothing) {
    Scene scene(0.3);
    for (int frame = 0; frame < 400; ++frame)  // there and back: warm
        scene.fly(approach(frame), frame / 60.0, 100'000);
    const uint64_t before = lod_test::allocation_count();
    for (int frame = 0; frame < 300; ++frame)
        scene.fly(approach(frame), 10.0 + frame / 60.0, 100'000);
    EXPECT_EQ(lod_test::allocation_count(), before);
    for (int frame = 0; frame < 60; ++frame)  // what glides arrives
        scene.fly(approach(300), 15.0 + frame / 60.0, 100'000);
    scene.fly(approach(300), 16.0 + 1.0 / 60.0, 100'000);
    EXPECT_EQ(scene.pool.index_bytes + scene.pool.vertex_bytes, 0u);
}

/// The farthest that any sample of a drawn surface is from the next frame's, on the screen.
struct Popping {
    double measured_px = 0.0, told_px = 0.0;
};
Popping popping(double glide_s) {
    Scene scene(glide_s);
    lod::Rng rng(9);
    Popping worst;
    lod_test::Soup last;
    for (int frame = 0; frame < 60; ++frame) {
        const View view = approach(20 + frame);
        scene.fly(view, frame / 60.0, frame == 0 ? UINT64_MAX : 200);
        const lod_test::Soup now = scene.pool.drawn(scene.list);
        if (frame > 0 && frame % 5 == 0) {
            const double moved = lod_test::farthest_px(lod_test::samples_of(last, rng),
                                                       lod_test::CellGrid(now), lod::metric_of(view));
            EXPECT_LE(moved, scene.front.jump_px() + 1e-3) << "frame " << frame << ", glide " << glide_s;
            worst.measured_px = std::max(worst.measured_px, moved);
            worst.told_px = std::max(worst.told_px, scene.front.jump_px());
        }
        last = now;
    }
    return worst;
}

TEST(MeshSheet, GlidingMovesTheSurfaceByLessThanToldAndByLessThanJumping) {
    const Popping jumping = popping(0.0), gliding = popping(0.5);
    EXPECT_GT(jumping.measured_px, 0.0);
    EXPECT_LT(gliding.measured_px, jumping.measured_px / 2.0);
    RecordProperty("jumping_px",
                   std::to_string(jumping.measured_px) + " told " + std::to_string(jumping.told_px));
    RecordProperty("gliding_px",
                   std::to_string(gliding.measured_px) + " told " + std::to_string(gliding.told_px));
}

}  // namespace
