#include "data/scene_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "data/object_plan.h"
#include "lod/base/rng.h"

namespace data {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A scene of 100 s with one triangle for a mesh.
TimedScene make_scene() {
    TimedScene scene;
    scene.end_s = 100.0;
    scene.meshes.push_back({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                            std::vector<glm::vec3>(3, {0, 0, 1}),
                            std::vector<glm::u8vec4>(3, {200, 200, 200, 255}),
                            {{0, 1, 2}}});
    return scene;
}

ObjectPlan make_plan(std::vector<VisibilityStep> events) {
    return {0, "part", std::move(events), {KeyFrame{}}};
}

/// The object of a scene that has no other.
TimedScene scene_of(const ObjectPlan& plan) {
    TimedScene scene = make_scene();
    const auto index = append_object(plan, scene);
    EXPECT_TRUE(index) << index.message();
    EXPECT_TRUE(check_timed_scene(scene));
    return scene;
}

/// Which of the times an object of these events is seen at, as a string of 0 and 1.
std::string seen(std::vector<VisibilityStep> events, const std::vector<double>& times_s) {
    const TimedScene scene = scene_of(make_plan(std::move(events)));
    std::string text;
    for (double time_s : times_s)
        text += is_visible(scene, scene.objects[0], time_s) ? '1' : '0';
    return text;
}

TEST(SceneTime, AnEventHoldsFromItsInstantOn) {
    const std::vector<double> times_s = {
        0.0, std::nextafter(20.0, 0.0), 20.0, 50.0, std::nextafter(70.0, 0.0), 70.0, 100.0};
    EXPECT_EQ(seen({}, times_s), "1111111");
    EXPECT_EQ(seen({{20.0, true}, {70.0, false}}, times_s), "0011100");
    EXPECT_EQ(seen({{20.0, false}, {70.0, true}}, times_s), "1100011");
    EXPECT_EQ(seen({{70.0, false}, {20.0, true}}, times_s), "0011100") << "in any order";
}

TEST(SceneTime, EventsOfOneInstantThatCancelAreNeverSeen) {
    const std::vector<double> times_s = {0.0, 20.0, 100.0};
    EXPECT_EQ(seen({{20.0, true}, {20.0, false}}, times_s), "000");
    EXPECT_EQ(seen({{20.0, false}, {20.0, true}}, times_s), "111");
    EXPECT_EQ(seen({{20.0, true}, {20.0, false}, {20.0, true}}, times_s), "011")
        << "the last one listed holds";
    EXPECT_EQ(seen({{0.0, true}, {0.0, false}}, times_s), "000");
}

TEST(SceneTime, TimesBeforeTheBeginningAndAfterTheEnd) {
    const std::vector<double> times_s = {-kInfinity, -5.0, 0.0, kNan, 100.0, 1e9, kInfinity};
    EXPECT_EQ(seen({{-3.0, true}}, times_s), "1111111") << "it happened at 0";
    EXPECT_EQ(seen({{0.0, true}}, times_s), "1111111");
    EXPECT_EQ(seen({{100.0, true}}, times_s), "0000111");
    EXPECT_EQ(seen({{101.0, true}}, times_s), "0000000") << "it never happens";
    EXPECT_EQ(seen({{0.0, false}}, times_s), "0000000");
    EXPECT_EQ(seen({{-1e9, true}, {1e9, false}}, times_s), "1111111");
}

/// Spans and integrals against counting instants, for events at whole and half seconds, repeated and outside.
TEST(SceneTime, SpansAndIntegralAgreeWithAskingEveryInstant) {
    lod::Rng rng(7);
    for (int round = 0; round < 500; ++round) {
        std::vector<VisibilityStep> events;
        for (uint64_t i = rng.below(7); i > 0; --i)
            events.push_back({static_cast<double>(rng.below(240)) / 2.0 - 10.0, rng.below(2) == 0});
        const TimedScene scene = scene_of(make_plan(events));
        const TimedObject& object = scene.objects[0];
        std::vector<TimeSpan> spans;
        visible_spans(scene, object, spans);
        double seen_s = 0.0, spans_s = 0.0;
        for (int quarter = 0; quarter < 400; ++quarter) {
            const double time_s = quarter * 0.25 + 0.125;
            bool is_in_span = false;
            for (const TimeSpan& span : spans)
                is_in_span = is_in_span || (span.begin_s <= time_s && time_s < span.end_s);
            ASSERT_EQ(is_in_span, is_visible(scene, object, time_s)) << "round " << round << " at " << time_s;
            seen_s += is_in_span ? 0.25 : 0.0;
        }
        for (size_t i = 0; i < spans.size(); ++i) {
            spans_s += spans[i].end_s - spans[i].begin_s;
            ASSERT_TRUE(i == 0 || spans[i - 1].end_s < spans[i].begin_s);
        }
        ASSERT_EQ(visible_s(scene, object), seen_s) << "round " << round;
        ASSERT_EQ(spans_s, seen_s);
    }
}

TEST(SceneTime, ABillionSecondsLoseNothing) {
    TimedScene scene = make_scene();
    scene.end_s = 1e9;
    ASSERT_TRUE(append_object(make_plan({{123456789.25, true}, {999999999.5, false}}), scene));
    EXPECT_EQ(visible_s(scene, scene.objects[0]), 999999999.5 - 123456789.25);
    EXPECT_FALSE(is_visible(scene, scene.objects[0], 123456789.0));
    EXPECT_TRUE(is_visible(scene, scene.objects[0], 123456789.25));
}

KeyFrame key(double time_s, double x, double turn_deg = 0.0) {
    const double half_rad = turn_deg * std::acos(-1.0) / 360.0;
    return {time_s, {x, 0.0, 0.0}, glm::dquat(std::cos(half_rad), 0.0, 0.0, std::sin(half_rad))};
}

TEST(SceneTime, PosesAreInterpolatedAndRestOutside) {
    ObjectPlan plan = make_plan({});
    plan.keys = {key(30.0, 4.0, 90.0), key(10.0, 0.0), key(50.0, 4.0, 90.0)};  // out of order
    const TimedScene scene = scene_of(plan);
    const TimedObject& object = scene.objects[0];
    EXPECT_EQ(pose_at(scene, object, 0.0).position.x, 0.0);
    EXPECT_EQ(pose_at(scene, object, 15.0).position.x, 1.0);
    EXPECT_EQ(pose_at(scene, object, 30.0).position.x, 4.0);
    EXPECT_EQ(pose_at(scene, object, 1e9).position.x, 4.0);
    EXPECT_EQ(pose_at(scene, object, kNan).position.x, 0.0);
    const glm::dvec3 third = pose_at(scene, object, 10.0 + 20.0 / 3.0).rotation * glm::dvec3(1.0, 0.0, 0.0);
    EXPECT_NEAR(third.x, std::sqrt(3.0) / 2.0, 1e-12);  // 30 degrees
    EXPECT_NEAR(third.y, 0.5, 1e-12);
}

TEST(SceneTime, RotationsTakeTheShorterArc) {
    ObjectPlan plan = make_plan({});
    plan.keys = {key(0.0, 0.0, -10.0), key(20.0, 0.0, 10.0)};
    plan.keys[1].rotation *= -3.0;  // the same rotation, from the other side and too long
    const TimedScene scene = scene_of(plan);
    const glm::dvec3 middle = pose_at(scene, scene.objects[0], 10.0).rotation * glm::dvec3(1.0, 0.0, 0.0);
    EXPECT_NEAR(middle.x, 1.0, 1e-12);
}

TEST(SceneTime, OfKeyFramesOfOneInstantTheLastHolds) {
    ObjectPlan plan = make_plan({});
    plan.keys = {key(10.0, 1.0), key(10.0, 2.0), key(10.0, 3.0)};
    const TimedScene scene = scene_of(plan);
    EXPECT_EQ(scene.keys.size(), 1u);
    EXPECT_EQ(pose_at(scene, scene.objects[0], 10.0).position.x, 3.0);
    EXPECT_EQ(motion_class(scene, scene.objects[0]), MotionClass::kStatic);
}

TEST(SceneTime, ClassesFollowWhatIsSeen) {
    const auto class_of = [](std::vector<VisibilityStep> events, std::vector<KeyFrame> keys) {
        ObjectPlan plan = make_plan(std::move(events));
        plan.keys = std::move(keys);
        const TimedScene scene = scene_of(plan);
        return motion_class(scene, scene.objects[0]);
    };
    EXPECT_EQ(class_of({}, {key(0, 0)}), MotionClass::kStatic);
    EXPECT_EQ(class_of({{-1.0, true}, {200.0, false}}, {key(0, 0)}), MotionClass::kStatic);
    EXPECT_EQ(class_of({}, {key(0, 5), key(9, 5)}), MotionClass::kStatic) << "it stays where it is";
    EXPECT_EQ(class_of({{5.0, true}}, {key(0, 0)}), MotionClass::kPseudoDynamic);
    EXPECT_EQ(class_of({{100.0, false}}, {key(0, 0)}), MotionClass::kPseudoDynamic);
    EXPECT_EQ(class_of({{0.0, false}}, {key(0, 0)}), MotionClass::kPseudoDynamic) << "never seen";
    EXPECT_EQ(class_of({}, {key(0, 0), key(9, 5)}), MotionClass::kDynamic);
    EXPECT_EQ(class_of({}, {key(0, 0), key(9, 0, 5.0)}), MotionClass::kDynamic);
}

TEST(SceneTime, WhatIsNoNumberIsAnErrorThatNamesTheObject) {
    for (const double time_s : {kNan, kInfinity, -kInfinity}) {
        TimedScene scene = make_scene();
        EXPECT_NE(append_object(make_plan({{time_s, true}}), scene).message().find("'part'"),
                  std::string::npos);
        ObjectPlan plan = make_plan({});
        plan.keys.push_back(key(time_s, 0.0));
        EXPECT_FALSE(append_object(plan, scene));
        plan.keys = {key(0.0, time_s)};
        EXPECT_FALSE(append_object(plan, scene));
        plan.keys = {};
        EXPECT_FALSE(append_object(plan, scene)) << "no place at all";
        plan.keys = {{0.0, {}, glm::dquat(0.0, 0.0, 0.0, 0.0)}};
        EXPECT_FALSE(append_object(plan, scene)) << "no rotation";
        EXPECT_TRUE(scene.objects.empty() && scene.steps.empty() && scene.keys.empty());
    }
}

TEST(SceneTime, TheCheckFindsWhatIsBroken) {
    const auto broken = [](const auto& damage) {
        ObjectPlan plan = make_plan({{5.0, true}, {6.0, false}});
        plan.keys = {key(0, 0), key(9, 5)};
        TimedScene scene = scene_of(plan);
        damage(scene);
        return !check_timed_scene(scene);
    };
    EXPECT_FALSE(broken([](TimedScene&) {}));
    EXPECT_FALSE(broken([](TimedScene& s) { s.meshes[0].triangles.clear(); })) << "no triangles is no fault";
    EXPECT_FALSE(broken([](TimedScene& s) {
        s.meshes[0].triangles.assign(9, {1, 1, 2});
    })) << "a soup is none";
    EXPECT_TRUE(broken([](TimedScene& s) { s.end_s = 0.0; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.end_s = kNan; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.meshes[0].triangles[0][1] = 3; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.meshes[0].positions[0].x = std::nanf(""); }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.meshes[0].normals[2] *= 2.0f; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.meshes[0].colours.pop_back(); }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.objects[0].mesh = 1; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.objects[0].steps.end = 3; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.objects[0].keys = {1, 1}; }));
    EXPECT_TRUE(broken([](TimedScene& s) { std::swap(s.steps[0], s.steps[1]); }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.steps[1].time_s = s.steps[0].time_s; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.keys[1].time_s = kNan; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.keys[1].rotation *= 2.0; }));
    EXPECT_TRUE(broken([](TimedScene& s) { s.objects.push_back(s.objects[0]); })) << "two of one id";
}

}  // namespace
}  // namespace data
