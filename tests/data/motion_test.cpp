#include "data/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include "data/time_text.h"
#include "lod/base/rng.h"
#include "tests/data/own_path.h"

namespace {

namespace fs = std::filesystem;
using data::Motion;
using data::MotionSample;

constexpr double kDegree_rad = std::numbers::pi / 180.0;

fs::path shared_data() {
    return fs::path(HARRIER_SOURCE_DIR) / "../shared/data";
}

std::string write_file(const std::string& name, const std::string& content) {
    const std::string path = test::own_path(name);
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

lod::Result<Motion> read_csv(const std::string& content) {
    return data::read_motion(write_file("rows.csv", content));
}

// Samples on a plane, level, at the given times and places.
Motion plane_motion(const std::vector<glm::dvec3>& time_x_y) {
    Motion motion;
    motion.is_geographic = false;
    for (const glm::dvec3& row : time_x_y) {
        MotionSample sample;
        sample.time_s = row.x;
        sample.site = {row.y, row.z, 0.0};
        motion.samples.push_back(sample);
    }
    return motion;
}

glm::dvec2 place_at(const Motion& motion, double time_s) {
    const MotionSample sample = data::motion_at(motion, time_s);
    return {sample.site.x, sample.site.y};
}

TEST(TimeText, AgreesWithTheCLibrary) {
    lod::Rng rng(3);
    for (int i = 0; i < 500; ++i) {
        const std::time_t moment = static_cast<std::time_t>(rng.below(4'000'000'000u)) - 1'000'000'000;
        std::tm parts{};
        gmtime_r(&moment, &parts);
        char text[64];
        std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
        const std::optional<double> parsed = data::parse_iso_time(text);
        ASSERT_TRUE(parsed) << text;
        ASSERT_EQ(*parsed, static_cast<double>(moment)) << text;
    }
}

TEST(TimeText, KnowsTheFormsAndRefusesTheRest) {
    const double noon = *data::parse_iso_time("2020-02-29T12:00:00Z");
    for (const char* same : {"2020-02-29 12:00", "2020-02-29T12:00:00.000", "2020-02-29T14:00:00+02:00",
                             "2020-02-29T05:30:00-0630", "2020-02-29T13:00:00+01"})
        EXPECT_EQ(data::parse_iso_time(same).value_or(0.0), noon) << same;
    EXPECT_NEAR(*data::parse_iso_time("2020-02-29T12:00:00.25Z") - noon, 0.25, 1e-6);
    EXPECT_EQ(data::parse_clock("-01:30").value_or(0.0), -5400.0);
    for (const char* wrong : {"", "2021-02-29T12:00:00", "2020-13-01", "2020-02-29T12", "2020-02-29T12:60",
                              "20200229", "2020-02-29T12:00:00X", "2020-02-29T12:00:00 and more", "12:00:00"})
        EXPECT_FALSE(data::parse_iso_time(wrong)) << wrong;
}

TEST(Motion, ReadsPlainCsvInAnyUnits) {
    const auto metric =
        read_csv("time,lon,lat,height,heading,pitch,roll\n10,7,44,100,350,5,-10\n12,7.1,44.1,200,10,0,0\n");
    ASSERT_TRUE(metric) << metric.message();
    EXPECT_TRUE(metric->has_attitude);
    EXPECT_TRUE(metric->is_geographic);
    ASSERT_EQ(metric->samples.size(), 2u);
    EXPECT_EQ(metric->duration_s(), 2.0);
    EXPECT_EQ(metric->samples[0].site.x, 7.0);
    EXPECT_EQ(metric->samples[0].site.y, 44.0);
    EXPECT_EQ(metric->samples[0].site.height_m, 100.0);
    EXPECT_NEAR(metric->samples[0].heading_rad, 350 * kDegree_rad, 1e-12);
    EXPECT_NEAR(metric->samples[0].pitch_rad, 5 * kDegree_rad, 1e-12);
    EXPECT_NEAR(metric->samples[0].roll_rad, -10 * kDegree_rad, 1e-12);

    const char* const same[] = {
        "Time_ms;Altitude (ft);Latitude;Longitude;Roll_rad;Pitch_rad;Yaw_rad\n"
        "10000;328.083989501;44;7;-0.17453292520;0.08726646260;6.10865238198\n12000;656.1679790;44.1;7.1;0;0;"
        "0.17453292520\n",
        "# s,deg,deg,ft msl,rad,deg,deg\ntime,lon,lat,altmsl,hdg,pitch,bank\n"
        "10,7,44,328.083989501,6.10865238198,5,-10\n\n# remark\n12,7.1,44.1,656.167979,0.1745329252,0,0\n",
        "\xef\xbb\xbf\"time\"\t\"lon\"\t\"lat\"\t\"height\"\t\"heading\"\t\"pitch\"\t\"roll\"\r\n"
        "1970-01-01T00:00:10Z\t7\t44\t\"100\"\t350\t5\t-10\r\n1970-01-01 "
        "00:00:12\t7.1\t44.1\t200\t10\t0\t0\r\n",
    };
    for (const char* content : same) {
        const auto other = read_csv(content);
        ASSERT_TRUE(other) << other.message();
        ASSERT_EQ(other->samples.size(), 2u) << content;
        for (size_t i = 0; i < 2; ++i) {
            const MotionSample &a = metric->samples[i], &b = other->samples[i];
            EXPECT_NEAR(a.time_s, b.time_s, 1e-9);
            EXPECT_NEAR(a.site.x, b.site.x, 1e-12);
            EXPECT_NEAR(a.site.height_m, b.site.height_m, 1e-6);
            EXPECT_NEAR(a.heading_rad, b.heading_rad, 1e-9);
            EXPECT_NEAR(a.pitch_rad, b.pitch_rad, 1e-9);
            EXPECT_NEAR(a.roll_rad, b.roll_rad, 1e-9);
        }
    }
}

TEST(Motion, AltitudesOfStateVectorsAreFeet) {
    const auto feet =
        read_csv("time_utc,latitude,longitude,altitude,groundspeed\n1,44,7,1000,90\n2,44,7.1,1000,90\n");
    ASSERT_TRUE(feet) << feet.message();
    EXPECT_NEAR(feet->samples[0].site.height_m, 304.8, 1e-9);
    const auto metres = read_csv("time,latitude,longitude,altitude\n1,44,7,1000\n2,44,7.1,1000\n");
    ASSERT_TRUE(metres) << metres.message();
    EXPECT_EQ(metres->samples[0].site.height_m, 1000.0);
    const auto explicit_unit =
        read_csv("time,latitude,longitude,altitude_m,groundspeed\n1,44,7,1000,90\n2,44,7.1,1000,90\n");
    ASSERT_TRUE(explicit_unit) << explicit_unit.message();
    EXPECT_EQ(explicit_unit->samples[0].site.height_m, 1000.0);
}

TEST(Motion, CountsRowsThatAreNoFixes) {
    const auto motion = read_csv(
        "time,x,y,height\n1,0,0,0\n2,,0,0\n2,1,1,0\n2,2,2,0\n1,3,3,0\n3,nan,3,0\n4,text,3,0\n5\n6,4,4,\n7,5,"
        "5,9\n");
    ASSERT_TRUE(motion) << motion.message();
    EXPECT_FALSE(motion->is_geographic);
    EXPECT_EQ(motion->samples.size(), 3u);
    EXPECT_EQ(motion->dropped, 7u);
    EXPECT_EQ(motion->duration_s(), 6.0);
}

TEST(Motion, ClockTimesPassMidnight) {
    const auto motion = read_csv("time,x,y,height\n23:59:58,0,0,0\n23:59:59.5,1,0,0\n00:00:01,2,0,0\n");
    ASSERT_TRUE(motion) << motion.message();
    ASSERT_EQ(motion->samples.size(), 3u);
    EXPECT_NEAR(motion->duration_s(), 3.0, 1e-9);
}

TEST(Motion, UnusableFilesAreRefusedInOneLine) {
    const std::pair<std::string, const char*> cases[] = {
        {"/nonexistent.csv", "no such file"},
        {"/nonexistent.gpx", "cannot read GPX"},
        {write_file("empty.csv", ""), "header"},
        {write_file("comments.csv", "# nothing\n"), "header"},
        {write_file("place.csv", "\n\ntime,lon,height\n1,2,3\n"), "place.csv:3: no columns for the place"},
        {write_file("time.csv", "lon,lat,height\n1,2,3\n"), "time.csv:1: no column for the time"},
        {write_file("height.csv", "time,lon,lat\n1,2,3\n"), "height.csv:1: no column for the height"},
        {write_file("one.csv", "time,lon,lat,height\n1,2,3,4\n2,2,95,4\n"), "1 usable rows of 2"},
        {write_file("noise.gpx", "noise"), "cannot read GPX"},
    };
    for (const auto& [path, part] : cases) {
        const auto motion = data::read_motion(path);
        ASSERT_FALSE(motion) << path;
        EXPECT_NE(motion.message().find(part), std::string::npos) << motion.message();
        EXPECT_EQ(motion.message().find('\n'), std::string::npos);
    }
}

TEST(Motion, ReadsGpxTracks) {
    std::string text =
        "<?xml version=\"1.0\"?><gpx version=\"1.1\" creator=\"t\" "
        "xmlns=\"http://www.topografix.com/GPX/1/1\"><trk><trkseg>";
    for (int i = 0; i < 5; ++i) {
        text += "<trkpt lat=\"44.00" + std::to_string(i) + "\" lon=\"7\"><ele>" + std::to_string(100 + i) +
                "</ele><time>2020-01-01T00:00:0" + std::to_string(i) + ".500Z</time></trkpt>";
    }
    const std::string end = "<trkpt lat=\"45\" lon=\"7\"></trkpt></trkseg></trk></gpx>";
    const auto motion = data::read_motion(write_file("track.gpx", text + end));
    ASSERT_TRUE(motion) << motion.message();
    ASSERT_EQ(motion->samples.size(), 5u);
    EXPECT_EQ(motion->dropped, 1u);
    EXPECT_NEAR(motion->duration_s(), 4.0, 1e-3);
    EXPECT_NEAR(motion->samples[4].site.y, 44.004, 1e-12);
    EXPECT_EQ(motion->samples[4].site.height_m, 104.0);
    EXPECT_NEAR(std::remainder(motion->samples[2].heading_rad, 2.0 * std::numbers::pi), 0.0, 1e-9);
    EXPECT_FALSE(data::read_motion(write_file("cut.gpx", text)));
}

// A climbing circle to the right: the bank of a coordinated turn is atan(v^2 / (g r)), whatever the step.
TEST(Motion, AttitudeFollowsFromThePath) {
    const double speed_mps = 100.0, radius_m = 2000.0, climb_mps = 5.0;
    for (const double step_s : {0.2, 1.0, 5.0}) {
        std::ostringstream rows;
        rows.precision(15);
        rows << "time,x,y,height\n";
        for (double t = 0.0; t < 200.0; t += step_s) {
            const double turn = speed_mps * t / radius_m;
            rows << t << "," << radius_m * (1.0 - std::cos(turn)) << "," << radius_m * std::sin(turn) << ","
                 << climb_mps * t << "\n";
        }
        const auto motion = read_csv(rows.str());
        ASSERT_TRUE(motion) << motion.message();
        EXPECT_FALSE(motion->has_attitude);
        const double bank_rad = std::atan(speed_mps * speed_mps / (9.80665 * radius_m));
        for (const MotionSample& sample : motion->samples) {
            if (sample.time_s < 15.0 || sample.time_s > 180.0) continue;
            const double turned = sample.heading_rad - speed_mps * sample.time_s / radius_m;
            EXPECT_NEAR(std::remainder(turned, 2.0 * std::numbers::pi), 0.0, 0.2 * kDegree_rad);
            EXPECT_NEAR(sample.roll_rad, bank_rad, 0.5 * kDegree_rad);
            EXPECT_NEAR(sample.pitch_rad, std::atan(climb_mps / speed_mps), 0.1 * kDegree_rad);
        }
    }
}

TEST(Motion, StandingStillKeepsTheHeading) {
    const auto motion =
        read_csv("time,x,y,height\n0,0,0,0\n1,0,0,0\n2,50,0,0\n3,100,0,0\n4,100,0,0\n9,100,0.1,0\n");
    ASSERT_TRUE(motion) << motion.message();
    for (const MotionSample& sample : motion->samples)
        EXPECT_NEAR(sample.heading_rad, 0.5 * std::numbers::pi, 1e-6);
}

TEST(MotionAt, PassesThroughTheSamplesWithoutAJerk) {
    lod::Rng rng(9);
    std::vector<glm::dvec3> rows;
    for (double t = 0.0; rows.size() < 200; t += rng.between(0.1, 10.0))
        rows.emplace_back(t, rng.between(-100, 100), rng.between(-100, 100));
    const Motion motion = plane_motion(rows);
    const double h = 1e-7;
    for (size_t i = 0; i < rows.size(); ++i) {
        const glm::dvec2 here = place_at(motion, rows[i].x);
        EXPECT_NEAR(glm::distance(here, {rows[i].y, rows[i].z}), 0.0, 1e-9);
        if (i == 0 || i + 1 == rows.size()) continue;
        const glm::dvec2 before = (here - place_at(motion, rows[i].x - h)) / h;
        const glm::dvec2 after = (place_at(motion, rows[i].x + h) - here) / h;
        EXPECT_NEAR(glm::distance(before, after), 0.0, 1e-3 * (1.0 + glm::length(before))) << i;
    }
    EXPECT_EQ(data::motion_at(motion, -5.0).time_s, 0.0);
    EXPECT_EQ(data::motion_at(motion, std::numeric_limits<double>::quiet_NaN()).time_s, 0.0);
    EXPECT_EQ(data::motion_at(motion, 1e9).time_s, motion.duration_s());
}

// Equal steps on a straight line and on a parabola are reproduced; between uneven ones nothing swings out.
TEST(MotionAt, NeitherOvershootsNorLoops) {
    Motion line = plane_motion({{0, 0, 0}, {1, 10, 0}, {2, 20, 0}, {3, 30, 0}});
    for (double t = 0.0; t <= 3.0; t += 0.01)
        EXPECT_NEAR(place_at(line, t).x, 10.0 * t, 1e-9);
    Motion parabola = plane_motion({{0, 0, 0}, {1, 1, 1}, {3, 3, 9}, {4, 4, 16}, {6, 6, 36}});
    for (double t = 1.0; t <= 4.0; t += 0.01)
        EXPECT_NEAR(place_at(parabola, t).y, t * t, 1e-9);

    const Motion stop =
        plane_motion({{0, 0, 0}, {1, 100, 0}, {2, 200, 0}, {3, 200, 0}, {60, 200, 0}, {61, 300, 0}});
    double last = 0.0;
    for (double t = 0.0; t <= 61.0; t += 0.01) {
        const double x = place_at(stop, t).x;
        EXPECT_GE(x, last - 1e-9) << t;
        EXPECT_TRUE(t < 2.0 || t > 60.0 || std::abs(x - 200.0) < 1e-9) << t;
        last = x;
    }
    const Motion uneven = plane_motion({{0, 0, 0}, {0.1, 10, 0}, {30, 12, 1}, {30.1, 12, 11}, {60, 13, 12}});
    for (double t = 0.0; t <= 60.0; t += 0.01) {
        const glm::dvec2 place = place_at(uneven, t);
        EXPECT_TRUE(place.x > -1.0 && place.x < 14.0 && place.y > -1.0 && place.y < 13.0) << t;
    }
}

TEST(MotionAt, TurnsTheShortWayAndCrossesTheAntimeridian) {
    const auto motion = read_csv(
        "time,lon,lat,height,heading,pitch,roll\n0,179.8,0,0,350,0,-20\n1,-179.9,0,0,10,4,20\n"
        "2,-179.6,0,0,30,8,60\n");
    ASSERT_TRUE(motion) << motion.message();
    double last_x = 179.8;
    for (double t = 0.0; t <= 2.0; t += 0.01) {
        const MotionSample sample = data::motion_at(*motion, t);
        EXPECT_TRUE(std::abs(sample.site.x) <= 180.0);
        const double moved = std::remainder(sample.site.x - last_x, 360.0);
        EXPECT_TRUE(moved >= -1e-9 && moved < 0.01) << t;
        last_x = sample.site.x;
        EXPECT_LT(std::abs(std::remainder(sample.heading_rad, 2.0 * std::numbers::pi)), 30.1 * kDegree_rad);
        EXPECT_TRUE(sample.heading_rad >= 0.0 && sample.heading_rad < 2.0 * std::numbers::pi);
    }
    EXPECT_NEAR(data::motion_at(*motion, 0.5).roll_rad, 0.0, 1e-9);
}

TEST(Motion, ReadsTheRecordedFlight) {
    const fs::path path = shared_data() / "monaco/nice.csv";
    if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
    const auto motion = data::read_motion(path.string());
    ASSERT_TRUE(motion) << motion.message();
    EXPECT_EQ(motion->samples.size(), 1246u);
    EXPECT_EQ(motion->dropped, 0u);
    EXPECT_EQ(motion->duration_s(), 12'450.0);
    EXPECT_NEAR(motion->samples[0].site.x, 7.206073, 1e-9);
    EXPECT_NEAR(motion->samples[0].site.y, 43.655754, 1e-9);
    // The recorded ground speed, knots in column 5, is what the path itself says, as a whole: single fixes are up to
    // seconds off their times.
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    std::vector<double> ratio;
    const data::WorldFrame earth;
    for (size_t i = 0; std::getline(file, line); ++i) {
        std::istringstream cells(line);
        std::string cell;
        for (int column = 0; column < 5; ++column)
            std::getline(cells, cell, ',');
        const double t = motion->samples[i].time_s;
        const glm::dvec3 before = earth.world_from_site(data::motion_at(*motion, t - 1.0).site),
                         after = earth.world_from_site(data::motion_at(*motion, t + 1.0).site);
        const double speed_mps = std::stod(cell) * 1852.0 / 3600.0;
        if (speed_mps > 20.0) ratio.push_back(glm::distance(before, after) / 2.0 / speed_mps);
    }
    std::sort(ratio.begin(), ratio.end());
    EXPECT_NEAR(ratio[ratio.size() / 2], 1.0, 0.03);
}

// Derived attitude against the instruments of the same flight.
TEST(Motion, DerivedAttitudeResemblesTheRecordedOne) {
    const fs::path path = shared_data() / "motion/garmin_g1000.csv";
    if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
    const auto recorded = data::read_motion(path.string());
    ASSERT_TRUE(recorded) << recorded.message();
    EXPECT_TRUE(recorded->has_attitude);
    EXPECT_EQ(recorded->samples.size() + recorded->dropped, 442u);

    std::ostringstream rows;
    rows.precision(12);
    rows << "time,lon,lat,height\n";
    for (const MotionSample& sample : recorded->samples)
        rows << sample.time_s << "," << sample.site.x << "," << sample.site.y << "," << sample.site.height_m
             << "\n";
    const auto derived = read_csv(rows.str());
    ASSERT_TRUE(derived) << derived.message();
    ASSERT_EQ(derived->samples.size(), recorded->samples.size());
    std::vector<double> heading_off, roll_off;
    const data::WorldFrame earth;
    for (size_t i = 1; i < recorded->samples.size(); ++i) {
        const MotionSample &a = recorded->samples[i], &b = derived->samples[i];
        const double way_m = glm::distance(earth.world_from_site(a.site),
                                           earth.world_from_site(recorded->samples[i - 1].site));
        if (way_m < 30.0) continue;  // in the air
        heading_off.push_back(
            std::abs(std::remainder(a.heading_rad - b.heading_rad, 2.0 * std::numbers::pi)));
        roll_off.push_back(std::abs(a.roll_rad - b.roll_rad));
    }
    ASSERT_GT(heading_off.size(), 50u);
    std::sort(heading_off.begin(), heading_off.end());
    std::sort(roll_off.begin(), roll_off.end());
    EXPECT_LT(heading_off[heading_off.size() / 2], 8.0 * kDegree_rad);  // wind
    EXPECT_LT(roll_off[roll_off.size() / 2], 4.0 * kDegree_rad);
}

}  // namespace
