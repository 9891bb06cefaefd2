// Gliding vertices: what a frame changes on the drawn surface is what the front says it is, small, and gone in time.
#include <gtest/gtest.h>

#include "tests/terrain/surface_rig.h"
#include "tests/terrain/test_relief.h"

namespace {

constexpr int kSide = 257;
constexpr double kCell_m = 10.0, kRate = 60.0;

const data::HeightGrid& relief() {
    static const data::HeightGrid grid = terrain_test::fractal_grid(kSide, kSide, kCell_m, 400.0, 5);
    return grid;
}

/// 100 m/s over the relief, turning slowly.
lod::View flight(int frame) {
    const double t = frame / kRate;
    return terrain_test::level_view({300.0 + 80.0 * t, 400.0 + 60.0 * t, 420.0}, 0.7 + 0.05 * t, -0.15);
}

/// A front over it at 1 px.
struct Rig : terrain_test::SurfaceRig {
    explicit Rig(double glide_s) : SurfaceRig(relief(), 1.0, glide_s) {}
};

TEST(Glide, TheSurfaceMovesNoMoreThanTold) {
    Rig rig(0.4), jumping(0.0);
    double worst_px = 0.0, worst_told_px = 0.0, worst_jump_px = 0.0;
    for (int frame = 0; frame < 150; ++frame) {
        SCOPED_TRACE(frame);
        const lod::View view = flight(frame);
        rig.frame(view, frame / kRate);
        jumping.frame(view, frame / kRate);
        if (frame % 20 == 0) {
            ASSERT_EQ(rig.front.validate(), "");
        }
        if (frame == 0) continue;
        const double moved_px = rig.moved_px();
        ASSERT_LE(moved_px, rig.front.jump_px() + 1e-3);
        worst_px = std::max(worst_px, moved_px);
        worst_told_px = std::max(worst_told_px, rig.front.jump_px());
        worst_jump_px = std::max(worst_jump_px, jumping.moved_px());
    }
    RecordProperty("moved_px_gliding", std::to_string(worst_px));
    RecordProperty("moved_px_jumping", std::to_string(worst_jump_px));
    EXPECT_LE(worst_told_px, 0.2);
    EXPECT_GT(worst_jump_px, 0.6) << "the flight has nothing to smooth";
    EXPECT_GT(worst_px, 0.0);
}

/// In every frame, that in which vertices set out among them: what is drawn then is the mesh of before.
TEST(Glide, TheSurfaceIsNoFartherOffThanTold) {
    Rig rig(0.4);
    double worst_share = 0.0;
    for (int frame = 0; frame < 90; ++frame) {
        SCOPED_TRACE(frame);
        lod::View view = flight(frame);
        if (frame >= 30)
            view = terrain_test::level_view({900.0, 900.0, 460.0 - 2.0 * frame}, 0.03 * frame, -0.3);
        rig.frame(view, frame / kRate, frame % 10 < 5 ? 12 : UINT64_MAX);  // starved, then not
        const double off_px = rig.off_px(), told_px = rig.front.error_px();
        EXPECT_LE(off_px, told_px + 1e-3);
        worst_share = std::max(worst_share, off_px / told_px);
    }
    RecordProperty("worst_share", std::to_string(worst_share));
    EXPECT_GT(worst_share, 0.3);
}

TEST(Glide, StandingStillEverythingArrives) {
    Rig rig(0.4);
    for (int frame = 0; frame < 60; ++frame)
        rig.frame(flight(frame), frame / kRate);
    for (int frame = 60; frame < 100; ++frame)
        rig.frame(flight(60), frame / kRate);
    EXPECT_EQ(rig.front.jump_px(), 0.0);
    EXPECT_LE(rig.front.error_px(), 1.0);
    for (size_t i = 0; i < rig.now.size(); ++i) {
        if (std::isnan(rig.now[i])) continue;
        ASSERT_EQ(rig.now[i], rig.before[i]) << i;
    }
    EXPECT_EQ(rig.front.validate(), "");
}

TEST(Glide, ACutShowsTheMeshAtItsPlace) {
    Rig rig(0.4);
    for (int frame = 0; frame < 30; ++frame)
        rig.frame(flight(frame), frame / kRate);
    const lod::View elsewhere = terrain_test::level_view({2000.0, 1900.0, 350.0}, 3.9, -0.2);
    rig.frame(elsewhere, 30 / kRate);
    EXPECT_EQ(rig.front.jump_px(), 0.0);
    EXPECT_LE(rig.front.error_px(), 1.0);
    EXPECT_EQ(rig.front.validate(), "");
}

TEST(Glide, StarvedAndJerkyFlightStaysValid) {
    Rig rig(0.4);
    lod::Rng rng(6);
    double time_s = 0.0;
    for (int frame = 0; frame < 200; ++frame) {
        SCOPED_TRACE(frame);
        time_s += rng.between(0.0, 0.1);
        lod::View view = flight(static_cast<int>(rng.between(0.0, 240.0)));
        if (rng.unit() < 0.8) view = flight(frame);
        rig.frame(view, time_s, rng.below(60));
        ASSERT_EQ(rig.front.validate(), "");
    }
}

/// A glide is a function of time: where a vertex is does not depend on how often somebody looked.
TEST(Glide, DoesNotDependOnTheFrameRate) {
    terrain::VertexGlides seldom(0.5), often(0.5);
    terrain::VertexGlide glide;
    glide.base_from_place_m = {0.0f, 0.0f, 8.0f};
    std::vector<terrain::DiamondIndex> back;
    for (terrain::VertexGlides* glides : {&seldom, &often}) {
        for (terrain::DiamondIndex index : {10u, 11u}) {
            glide.index = index;
            glide.base.ends = {index == 10 ? 0u : 10u, 1u, 1u};
            glide.base.levels = {static_cast<uint8_t>(index == 10 ? 0 : 4), 0, 0};
            glide.base.shares = {0.5f, 0.5f, 0.0f};
            glides->start(glide, index == 10 ? 4 : 6, false, 1.0);
        }
    }
    for (int step = 1; step <= 300; ++step)
        often.advance(1.0 + step * 0.001, back);
    seldom.advance(1.3, back);
    for (const auto& [index, level] : {std::pair{10u, 4}, std::pair{11u, 6}}) {
        EXPECT_NEAR(often.displacement_m(index, level).z, seldom.displacement_m(index, level).z, 1e-5f);
        EXPECT_GT(often.displacement_m(index, level).z, 0.0f);
    }
    // The finer one hangs on an edge whose end is itself under way.
    EXPECT_GT(seldom.displacement_m(11, 6).z, seldom.displacement_m(10, 4).z);
}

}  // namespace
