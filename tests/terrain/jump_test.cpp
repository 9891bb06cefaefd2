// How far the drawn surface jumps, measured from outside and beside what the front says: near the ground, fast, over
// fine samples, where a frame's motion is large beside the distances.
#include <gtest/gtest.h>

#include "tests/terrain/surface_rig.h"
#include "tests/terrain/test_relief.h"

namespace {

using terrain_test::SurfaceRig;

constexpr double kRate = 60.0;

/// Its vertices all lie in the middle of their edges.
const data::HeightGrid& whole_relief() {
    static const data::HeightGrid grid = terrain_test::fractal_grid(513, 513, 1.0, 180.0, 1);
    return grid;
}
/// Not 2^k + 1 samples: at two borders vertices are off their edges, where a diagonal changes at once.
const data::HeightGrid& cut_relief() {
    static const data::HeightGrid grid = terrain_test::fractal_grid(480, 470, 1.0, 180.0, 1);
    return grid;
}

struct Jumps {
    double measured_px = 0.0, told_px = 0.0;
    int moved_frames = 0;
};

/// 100 m/s at 60 Hz; every frame's movement must have been told.
Jumps fly(SurfaceRig& rig, int frames, double turn_rad_s) {
    Jumps worst;
    const double height_m = double(rig.grid.max_m) + 30.0;
    for (int frame = 0; frame < frames; ++frame) {
        const double t = frame / kRate;
        const lod::View view = terrain_test::level_view({110.0 + 70.0 * t, 120.0 + 70.0 * t, height_m},
                                                        0.8 + turn_rad_s * t, -0.25);
        rig.frame(view, t);
        if (frame == 0) continue;
        const double moved_px = rig.moved_px();
        EXPECT_LE(moved_px, rig.front.jump_px() + 1e-3) << "frame " << frame;
        worst.measured_px = std::max(worst.measured_px, moved_px);
        worst.told_px = std::max(worst.told_px, rig.front.jump_px());
        worst.moved_frames += moved_px > 0.0 ? 1 : 0;
    }
    std::printf("the surface over a sample moved by at most %.2f px a frame, told %.2f\n", worst.measured_px,
                worst.told_px);
    EXPECT_EQ(rig.front.validate(), "");
    return worst;
}

TEST(Jump, GlidingNearTheGroundMovesLittle) {
    SurfaceRig rig(whole_relief(), 1.0, 0.4);
    const Jumps jumps = fly(rig, 45, 0.05);
    EXPECT_LE(jumps.told_px, 0.5);
    EXPECT_GT(jumps.moved_frames, 40);
}

/// A quick turn puts much out of view and brings much into it, but it is no cut; what nobody saw need not glide.
TEST(Jump, GlidesGoOnInAQuickTurn) {
    SurfaceRig rig(whole_relief(), 1.0, 0.4);
    const Jumps jumps = fly(rig, 45, 2.5);
    EXPECT_LE(jumps.told_px, 0.5);
}

TEST(Jump, WhatAClampedBorderDoesIsTold) {
    SurfaceRig rig(cut_relief(), 1.0, 0.4);
    EXPECT_GT(fly(rig, 45, 0.05).moved_frames, 40);
}

TEST(Jump, WithoutGlidingTheMovementIsTold) {
    SurfaceRig rig(whole_relief(), 1.0, 0.0);
    const Jumps jumps = fly(rig, 45, 0.05);
    EXPECT_GT(jumps.measured_px, 0.5) << "the flight has nothing to smooth";
    EXPECT_LE(jumps.told_px, 2.5);
}

}  // namespace
