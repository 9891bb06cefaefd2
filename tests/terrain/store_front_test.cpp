// A front over pages that come and go: always conforming and whole, its bound as good as on a table in memory, and
// the very same mesh once everything is there.
#include <gtest/gtest.h>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/conformity.h"
#include "tests/terrain/store_kit.h"

namespace {

using terrain_test::level_view;
using test::CutFolder;

constexpr double kTolerance_px = 2.0, kWant_px = 0.5 * kTolerance_px, kRate_hz = 15.0;

const data::HeightGrid& relief() {
    static const data::HeightGrid grid = terrain_test::fractal_grid(1025, 900, 10.0, 900.0, 1);
    return grid;
}

std::unique_ptr<terrain::RoamFront> paged_front(const std::string& path, size_t pages, double want_px,
                                                bool waits) {
    auto opened =
        open_paged_table(terrain_test::build_and_open(relief(), path),
                         {.memory_bytes = terrain_test::room_for(pages), .want_px = want_px, .waits = waits});
    EXPECT_TRUE(opened) << opened.message();
    return std::make_unique<terrain::RoamFront>(std::move(opened->table),
                                                terrain::RoamOptions{.tolerance_px = kTolerance_px},
                                                std::move(opened->loader));
}

void adapt(terrain::RoamFront& front, const lod::View& view, double time_s, uint64_t operations) {
    lod::Front* fronts[] = {&front};
    front.begin_frame({&view, 1}, time_s);
    lod::schedule(fronts, {.tolerance_px = kTolerance_px, .max_triangles = 60'000},
                  lod::operation_limit(operations));
}

/// Over the relief at 300 m/s, with a jump now and then.
lod::View flight_view(int frame) {
    const double s = 20.0 * (frame % 100) + 1500.0 * (frame / 100 % 4);
    return level_view({1000 + s, 800 + 0.7 * s, 700}, 0.8 + 0.016 * frame, -0.15);
}

/// Down onto everything.
lod::View map_view() {
    lod::View view = level_view({5120, 4500, 30'000}, 0.0, -1.5707963);
    return view;
}

/// Empty when the front covers all of its raster with a conforming mesh.
std::string hole_in(terrain::RoamFront& front) {
    terrain_test::PoolTwin pool;
    const auto triangles = terrain_test::emit_triangles(front, map_view(), pool);
    const int64_t whole = 2 * int64_t{relief().width - 1} * (relief().height - 1);
    if (terrain_test::area_of(triangles) != whole) return "does not cover its raster";
    return terrain_test::conformity_fault(triangles);
}

TEST(StoreFront, EverythingHereIsTheTableInMemory) {
    const CutFolder folder;
    const auto paged = paged_front(folder.file("a.hts"), 100, 0.0, true);
    terrain::RoamFront whole(terrain::make_diamond_table(relief(), 2), {.tolerance_px = kTolerance_px});
    for (int frame = 0; frame < 300; frame += 4) {
        adapt(*paged, flight_view(frame), frame / kRate_hz, 3000);
        adapt(whole, flight_view(frame), frame / kRate_hz, 3000);
        ASSERT_EQ(paged->hash(), whole.hash()) << "frame " << frame;
        ASSERT_EQ(paged->error_px(), whole.error_px());
    }
    EXPECT_GT(whole.triangles(), 5000u);
}

/// Pages that suffice, brought in time: the mesh is that of the table in memory although not everything is here.
TEST(StoreFront, WhatIsWantedSuffices) {
    const CutFolder folder;
    const auto paged = paged_front(folder.file("a.hts"), 80, kWant_px, true);
    terrain::RoamFront whole(terrain::make_diamond_table(relief(), 2), {.tolerance_px = kTolerance_px});
    int same = 0, frames = 0;
    for (int frame = 0; frame < 120; frame += 3, ++frames) {
        adapt(*paged, flight_view(frame), frame / kRate_hz, UINT64_MAX);
        adapt(whole, flight_view(frame), frame / kRate_hz, UINT64_MAX);
        same += paged->hash() == whole.hash() ? 1 : 0;
        EXPECT_LE(paged->error_px(), whole.error_px() * 1.0001) << "frame " << frame;
    }
    EXPECT_EQ(same, frames);
}

TEST(StoreFront, TooLittleRoomIsCoarserNeverMissing) {
    const CutFolder folder;
    const auto paged = paged_front(folder.file("a.hts"), 24, kWant_px, true);
    double worst_px = 0.0;
    for (int frame = 0; frame < 400; ++frame) {
        adapt(*paged, flight_view(frame), frame / kRate_hz, 2000);
        if (frame % 10 != 0) continue;
        ASSERT_EQ(paged->validate(), "") << "frame " << frame;
        if (frame % 40 == 0) {
            ASSERT_EQ(hole_in(*paged), "") << "frame " << frame;
        }
        worst_px = std::max(worst_px, paged->error_px());
    }
    EXPECT_GT(worst_px, 2.0 * kTolerance_px) << "the room was not too little";
    EXPECT_GT(paged->loader()->tally().evictions, 10u);
}

/// What an unsplit diamond in view may be off, by the facts of the whole table, is never above error_px().
TEST(StoreFront, ItsBoundIsTrue) {
    const CutFolder folder;
    const auto paged = paged_front(folder.file("a.hts"), 36, kWant_px, false);
    const terrain::DiamondTable whole = terrain::make_diamond_table(relief(), 2);
    const terrain::BoundMaker bound_of(whole);
    for (int frame = 0; frame < 400; frame += 4) {
        const lod::View view = flight_view(frame);
        adapt(*paged, view, frame / kRate_hz, 2000);
        const lod::ViewMetric metric = lod::metric_of(view);
        double worst_px = 0.0;
        for (terrain::DiamondIndex i = terrain::kRoot; i < paged->mesh().record_count(); ++i) {
            const terrain::Diamond& d = paged->mesh()[i];
            if (!d.is_used() || d.is_split) continue;
            const terrain::DiamondBound bound = bound_of(d, whole.at(d.centre(), d.level));
            const glm::dvec3 centre = metric.eye_from_world *
                                      (glm::dvec3(bound.centre) + bound_of.anchor_world() - metric.eye_world);
            if (lod::distance_outside_m(metric, centre, double(bound.radius_m)) > 0.0) continue;
            worst_px = std::max(worst_px, lod::screen_error_px(metric, centre, double(bound.radius_m),
                                                               double(bound.error_m)));
        }
        ASSERT_LE(worst_px, paged->error_px() * 1.0001) << "frame " << frame;
    }
}

}  // namespace
