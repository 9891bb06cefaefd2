// Eyepoints: paths as functions of time, checked against geometry done another way.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/ground_height.h"
#include "lod/base/rng.h"
#include "sim/drive_path.h"
#include "sim/flight_path.h"
#include "sim/plan_curve.h"
#include "sim/site_metres.h"

namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr data::WorldFrame kPlanar{false}, kDatum{true};

const std::vector<data::SitePoint> kPlanarTour = {
    {0, 0, 300}, {1500, 200, 420}, {2600, 1800, 380}, {900, 3300, 380}, {-1200, 2400, 600}};
const std::vector<data::SitePoint> kDatumTour = {
    {7.30, 43.66, 800}, {7.36, 43.70, 1200}, {7.33, 43.76, 1400}, {7.45, 43.80, 1000}};

double turned(double from_rad, double to_rad) {
    return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

TEST(PlanCurve, PassesThroughItsWaypoints) {
    for (const auto& [frame, tour] : {std::pair{kPlanar, kPlanarTour}, std::pair{kDatum, kDatumTour}}) {
        const sim::PlanCurve curve(tour, frame);
        for (const data::SitePoint& waypoint : tour) {
            double nearest_m = 1e9;
            for (double s = 0.0; s <= curve.length_m(); s += 0.5) {
                const data::SitePoint site = curve.at(s).site;
                const glm::dvec2 unit = sim::metres_per_unit(frame, waypoint);
                const double away_m =
                    std::hypot((site.x - waypoint.x) * unit.x, (site.y - waypoint.y) * unit.y);
                nearest_m = std::min(nearest_m, std::hypot(away_m, site.height_m - waypoint.height_m));
            }
            EXPECT_LT(nearest_m, 1.0);
        }
    }
}

TEST(PlanCurve, TwoWaypointsAreAStraightLine) {
    const sim::PlanCurve curve(std::vector<data::SitePoint>{{10, 20, 5}, {310, 420, 105}}, kPlanar);
    EXPECT_NEAR(curve.length_m(), 500.0, 1e-9);
    const sim::CurvePoint point = curve.at(250.0);
    EXPECT_NEAR(point.site.x, 160.0, 1e-9);
    EXPECT_NEAR(point.site.y, 220.0, 1e-9);
    EXPECT_NEAR(point.site.height_m, 55.0, 1e-9);
    EXPECT_NEAR(point.climb, 0.2, 1e-12);
    EXPECT_NEAR(point.curvature_right_per_m, 0.0, 1e-12);
    EXPECT_NEAR(point.heading_rad * kDegPerRad, 36.8698976, 1e-6);
}

TEST(PlanCurve, SpeedIsEvenInPlan) {
    const sim::PlanCurve curve(kPlanarTour, kPlanar);
    for (double s = 0.0; s + 1.0 < curve.length_m(); s += 7.3) {
        const data::SitePoint a = curve.at(s).site, b = curve.at(s + 1.0).site;
        EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 1.0, 1e-4) << s;
    }
}

TEST(PlanCurve, SpeedIsEvenOnTheEllipsoid) {
    const sim::PlanCurve curve(kDatumTour, kDatum);
    for (double s = 0.0; s + 10.0 < curve.length_m(); s += 101.0) {
        data::SitePoint a = curve.at(s).site, b = curve.at(s + 10.0).site;
        a.height_m = b.height_m = 0.0;
        const double way_m = glm::distance(kDatum.world_from_site(a), kDatum.world_from_site(b));
        EXPECT_NEAR(way_m, 10.0, 0.03) << s;  // the sheet is flat: 0.3 % over this tour
    }
}

TEST(PlanCurve, HeightsStayBetweenNeighbouringWaypoints) {
    const sim::PlanCurve curve(kPlanarTour, kPlanar);
    for (double s = 0.0; s < curve.length_m(); s += 1.0) {
        const double height = curve.at(s).site.height_m;
        EXPECT_GE(height, 300.0 - 1e-9);
        EXPECT_LE(height, 600.0 + 1e-9);
    }
}

TEST(PlanCurve, CurvatureHasNoSteps) {
    const sim::PlanCurve curve(kPlanarTour, kPlanar);
    for (double s = 0.0; s + 1.0 < curve.length_m(); s += 1.0) {
        const double change = curve.at(s + 1.0).curvature_right_per_m - curve.at(s).curvature_right_per_m;
        EXPECT_LT(std::abs(change), 2e-5) << s;
    }
}

TEST(PlanCurve, RepeatedAndSinglePlacesAreHarmless) {
    const sim::PlanCurve still(std::vector<data::SitePoint>{{1, 2, 3}, {1, 2, 3}}, kPlanar);
    EXPECT_EQ(still.length_m(), 0.0);
    EXPECT_EQ(still.at(5.0).site.x, 1.0);
    const sim::PlanCurve stutter(std::vector<data::SitePoint>{{0, 0, 0}, {0, 0, 9}, {100, 0, 0}}, kPlanar);
    EXPECT_NEAR(stutter.length_m(), 100.0, 1e-9);
}

TEST(PlanCurve, CrossesTheAntimeridianTheShortWay) {
    const sim::PlanCurve curve(std::vector<data::SitePoint>{{179.9, 10, 0}, {-179.9, 10, 0}}, kDatum);
    EXPECT_NEAR(curve.length_m(), 0.2 * 111319.49 * std::cos(10.0 / kDegPerRad), 100.0);
    EXPECT_LE(std::abs(curve.at(curve.length_m() * 0.75).site.x), 180.0);
}

TEST(FlightPath, BankBalancesTheTurn) {
    const sim::FlightPath path{sim::PlanCurve(kPlanarTour, kPlanar), 50.0};
    constexpr double kStep_s = 0.01;
    for (double t = 5.0; t + 5.0 < sim::duration_s(path); t += 0.37) {
        // Turn rate from three positions, averaged over the smoothing: independent of the curve's own curvature.
        double rate = 0.0, weight = 0.0;
        for (double offset = -2.0; offset <= 2.0; offset += 0.05) {
            const auto heading = [&](double at) {
                const auto a = sim::state_at(path, at - kStep_s).site,
                           b = sim::state_at(path, at + kStep_s).site;
                return std::atan2(b.x - a.x, b.y - a.y);
            };
            const double w = 0.5 + 0.5 * std::cos(std::numbers::pi * offset / 2.0);
            const double omega = turned(heading(t + offset - 0.05), heading(t + offset + 0.05)) / 0.1;
            rate += w * std::atan(50.0 * omega / 9.80665);
            weight += w;
        }
        EXPECT_NEAR(sim::state_at(path, t).roll_rad * kDegPerRad, rate / weight * kDegPerRad, 0.7) << t;
    }
}

TEST(FlightPath, BankIsBoundedAndRollIsSlow) {
    const std::vector<data::SitePoint> sharp = {{0, 0, 100}, {500, 0, 100}, {500, 60, 100}, {0, 60, 100}};
    const sim::FlightPath path{sim::PlanCurve(sharp, kPlanar), 80.0};
    for (double t = 0.0; t < sim::duration_s(path); t += 0.02) {
        const double roll = sim::state_at(path, t).roll_rad, next = sim::state_at(path, t + 0.02).roll_rad;
        EXPECT_LE(std::abs(roll) * kDegPerRad, 55.0 + 1e-9);
        EXPECT_LE(std::abs(next - roll) / 0.02 * kDegPerRad, 90.0) << t;
    }
}

TEST(FlightPath, RightTurnLowersTheRightWing) {
    const std::vector<data::SitePoint> right = {
        {0, 0, 100}, {0, 1000, 100}, {1000, 2000, 100}, {2000, 2000, 100}};
    const sim::FlightPath path{sim::PlanCurve(right, kPlanar), 60.0};
    EXPECT_GT(sim::state_at(path, sim::duration_s(path) / 2.0).roll_rad, 0.05);
}

TEST(FlightPath, AnyOrderOfTimesGivesTheSamePoses) {
    const sim::FlightPath path{sim::PlanCurve(kDatumTour, kDatum), 100.0};
    lod::Rng rng(5);
    for (int i = 0; i < 200; ++i) {
        const double t = rng.between(-10.0, sim::duration_s(path) + 10.0);
        const sim::EyeState first = sim::state_at(path, t);
        sim::state_at(path, rng.between(0.0, 100.0));
        const sim::EyeState second = sim::state_at(path, t);
        EXPECT_EQ(first.site.x, second.site.x);
        EXPECT_EQ(first.roll_rad, second.roll_rad);
    }
}

TEST(FlightPath, RestsAtItsEnds) {
    const sim::FlightPath path{sim::PlanCurve(kPlanarTour, kPlanar), 50.0};
    EXPECT_NEAR(sim::state_at(path, -5.0).site.x, 0.0, 1e-6);
    EXPECT_NEAR(sim::state_at(path, 1e6).site.x, -1200.0, 1e-6);
    EXPECT_EQ(sim::state_at(path, 1e6).speed_mps, 0.0);
    EXPECT_NEAR(sim::state_at(path, 1.0).speed_mps, 50.0, 0.5);
}

/// A plane rising `east` and `north` metres per metre.
data::HeightGrid slope(double east, double north) {
    constexpr int kSide = 65;
    constexpr double kSpacing_m = 10.0;
    std::vector<float> heights;
    for (int row = 0; row < kSide; ++row) {
        for (int col = 0; col < kSide; ++col) {
            const double x = col * kSpacing_m, y = (kSide - 1 - row) * kSpacing_m;
            heights.push_back(static_cast<float>(100.0 + east * x + north * y));
        }
    }
    return data::make_planar_grid(kSide, kSide, kSpacing_m, heights);
}

TEST(DrivePath, KeepsItsEyeOnTheSourceGround) {
    lod::Rng rng(11);
    std::vector<float> heights(65 * 65);
    for (float& height : heights)
        height = static_cast<float>(rng.between(0.0, 40.0));
    const data::HeightGrid ground = data::make_planar_grid(65, 65, 10.0, heights);
    const std::vector<data::SitePoint> tour = {{50, 50, 0}, {300, 90, 0}, {500, 400, 0}, {100, 560, 0}};
    const sim::DrivePath path{sim::PlanCurve(tour, kPlanar), 12.0, &ground, kPlanar};
    ASSERT_TRUE(sim::check_ground(path));
    for (double t = 0.0; t <= sim::duration_s(path); t += 0.11) {
        const sim::EyeState state = sim::state_at(path, t);
        const glm::dvec2 grid = ground.frame.grid_from_site(state.site);
        const double ground_m = data::ground_height(ground, grid.x, grid.y).height_m;
        EXPECT_NEAR(state.site.height_m, ground_m + 1.6, 1e-9);
    }
}

TEST(DrivePath, LeansWithTheSlope) {
    const data::HeightGrid ground = slope(0.1, 0.2);
    const std::vector<data::SitePoint> north = {{320, 100, 0}, {320, 500, 0}};
    const sim::DrivePath up{sim::PlanCurve(north, kPlanar), 10.0, &ground, kPlanar};
    const sim::EyeState state = sim::state_at(up, 20.0);
    EXPECT_NEAR(state.pitch_rad, std::atan(0.2), 1e-5);
    EXPECT_NEAR(state.roll_rad, -std::atan(0.1), 1e-5);  // the east, on the right, is higher
    EXPECT_NEAR(state.vertical_speed_mps, 2.0, 1e-4);
}

TEST(DrivePath, LeavingTheTerrainIsSaidBeforehand) {
    const data::HeightGrid ground = slope(0.0, 0.0);
    const std::vector<data::SitePoint> out = {{320, 100, 0}, {900, 100, 0}};
    const sim::DrivePath path{sim::PlanCurve(out, kPlanar), 10.0, &ground, kPlanar};
    const auto checked = sim::check_ground(path);
    ASSERT_FALSE(checked);
    EXPECT_NE(checked.message().find("645"), std::string::npos) << checked.message();
    EXPECT_NE(checked.message().find("expected"), std::string::npos);
}

}  // namespace
