// A line's track over the grid against exact positions, and its bend against what chords really lose.
#include "data/ground_track.h"

#include <gtest/gtest.h>

#include "tests/data/ground_twin.h"

namespace {

using data::TrackFit;
using data::TrackPiece;

const std::array<double, 6> kAcross = {179.0, 0.001, 0.0, 46.0, 0.0, -0.001};

glm::dvec3 at(double longitude, double latitude, double height_m) {
    return data::WorldFrame{}.world_from_site({longitude, latitude, height_m});
}

TEST(GroundTrack, FollowsALineForTensOfKilometres) {
    const auto frame = data::GroundFrame::make(kAcross, "EPSG:4326", 2000, 1000);
    ASSERT_TRUE(frame);
    const data::WorldLine line{at(179.8, 45.2, 900.0), at(180.3, 45.6, 300.0)};  // 59 km
    TrackPiece piece;
    ASSERT_EQ(data::fit_track(*frame, line, piece), TrackFit::kGood);
    for (double s = -1.0; s <= 1.0; s += 0.01) {
        const glm::dvec3 truth =
            test::twin_place(kAcross, 2000, glm::mix(line.from, line.to, piece.share_at(s)));
        const glm::dvec3 off = glm::abs(piece.at(s) - truth);
        EXPECT_LT(off.x, 1e-8);
        EXPECT_LT(off.y, 1e-8);
        EXPECT_LT(off.z, 1e-7);
    }
}

TEST(GroundTrack, KeepsItsTurnAcrossTheSeam) {
    // The grid's middle is at 0, so longitudes jump at 180.
    const std::array<double, 6> world = {-180.0, 0.1, 0.0, 50.0, 0.0, -0.1};
    const auto frame = data::GroundFrame::make(world, "EPSG:4326", 3600, 100);
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->full_turn_cells().x, 3600.0, 1e-9);
    EXPECT_EQ(frame->full_turn_cells().y, 0.0);
    TrackPiece piece;
    ASSERT_EQ(data::fit_track(*frame, {at(179.9, 45.0, 0.0), at(-179.9, 45.0, 0.0)}, piece), TrackFit::kGood);
    EXPECT_NEAR(std::abs(piece.at(1.0).x - piece.at(-1.0).x), 2.0, 1e-7);
}

TEST(GroundTrack, BendBoundsWhatChordsLose) {
    const auto frame = data::GroundFrame::make(kAcross, "EPSG:4326", 2000, 1000);
    lod::Rng rng(4);
    for (int i = 0; i < 200; ++i) {
        const auto end = [&] {
            return at(rng.between(179.2, 180.6), rng.between(45.2, 45.8), rng.between(-100.0, 5000.0));
        };
        TrackPiece piece;
        const data::WorldLine line{end(), end()};
        piece.end = 0.3;
        if (data::fit_track(*frame, line, piece) != TrackFit::kGood) continue;
        const double a = rng.between(-1.0, 1.0), b = rng.between(-1.0, 1.0);
        const glm::dvec3 chord = 0.5 * (piece.at(a) + piece.at(b)),
                         off = glm::abs(chord - piece.at(0.5 * (a + b)));
        const glm::dvec3 bound = piece.bend * ((a - b) * (a - b) / 8.0) + 1e-9;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(off[axis], bound[axis]);
            EXPECT_LE(bound[axis], 100.0 * off[axis] + 1e-3) << "a bound, but no use";
        }
    }
}

TEST(GroundTrack, KnowsWhenThereIsNone) {
    const auto frame = data::GroundFrame::make(kAcross, "EPSG:4326", 2000, 1000);
    TrackPiece piece;
    EXPECT_EQ(data::fit_track(*frame, {glm::dvec3(NAN), at(180.0, 45.0, 0.0)}, piece), TrackFit::kNowhere);
    EXPECT_EQ(data::fit_track(*frame, {at(179.0, 89.99, 0.0), at(-1.0, 89.99, 0.0)}, piece),
              TrackFit::kTooLong)
        << "over the pole";
}

}  // namespace
