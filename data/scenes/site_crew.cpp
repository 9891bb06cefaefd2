#include "data/scenes/site_crew.h"

#include <array>
#include <cmath>

#include "data/scenes/site_plan.h"

namespace data::site {

namespace {

constexpr double kWalkMps = 1.6, kRideMps = 4.0;

/// A person of 1.8 m, 92 triangles.
TimedMesh make_person(const Colour& vest, const Colour& helmet) {
    TimedMesh mesh;
    for (const double x : {-0.19, 0.02})
        append_box({x, -0.1, 0.0}, {x + 0.17, 0.12, 0.85}, {44, 52, 74}, mesh);
    append_box({-0.24, -0.13, 0.85}, {0.24, 0.13, 1.45}, vest, mesh);
    for (const double x : {-0.35, 0.25})
        append_box({x, -0.08, 0.75}, {x + 0.1, 0.08, 1.42}, vest, mesh);
    append_box({-0.1, -0.1, 1.45}, {0.1, 0.12, 1.68}, {202, 162, 134}, mesh);
    append_tube({{0, 0, 1.66}, {0, 0, 1.8}, 0.16, 6}, helmet, mesh);
    return mesh;
}

/// Where a person is, with key frames added on the way.
struct Walker {
    std::vector<KeyFrame> keys;
    glm::dvec3 at{0.0};
    double time_s = 0.0;

    void arrive(double when_s) {
        time_s = when_s;
        keys.back().time_s = when_s;
    }
    void wait(double for_s) {
        time_s += for_s;
        keys.push_back(keys.back());
        keys.back().time_s = time_s;
    }
    void go(const glm::dvec3& to, double speed_mps) {
        const glm::dvec3 way = to - at;
        const double length_m = glm::length(way);
        if (length_m < 0.01) return;
        const bool is_level = std::abs(way.x) + std::abs(way.y) > 0.01;
        const glm::dquat turned = key_at(0.0, {{}, std::atan2(-way.x, way.y)}).rotation;
        const glm::dquat rotation = is_level ? turned : keys.back().rotation;
        keys.push_back({time_s + 0.05, at, rotation});
        time_s += 0.05 + length_m / speed_mps;
        at = to;
        keys.push_back({time_s, at, rotation});
    }
};

/// Rows of people in front of the huts, which stand in four camps beyond the corners of the ring road.
glm::dvec3 camp_place(int number) {
    const int camp = number % 4, place = number / 4, col = place % 40, row = place / 40;
    const double turn_rad = camp * std::numbers::pi / 2.0;
    return (Placement{{}, turn_rad} * Placement{{102.0 + 1.1 * col, 100.0 + 1.3 * row, 0.0}}).position;
}

glm::dvec3 place_in_storey(int storey, SceneBuilder& builder) {
    const auto random = [&] { return builder.rng.between(-19.0, 19.0); };
    const double x = random(), y = random();
    return (storey_frame(storey) * Placement{{x, y, 0.0}}).position;
}

/// Works in the tower: from the camp to a hoist, up, and then a few storeys one after the other.
void work_in_tower(Walker& walker, SceneBuilder& builder) {
    int storey = static_cast<int>(builder.rng.below(kStoreys - 2));
    const double behind =
        builder.rng.between(1.5, 22.0);  // storeys behind the highest: from formwork to furniture
    const double starts_s = storey_time(storey + behind);
    const double side = walker.at.x < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 hoist(side * 27.5, -side * -17.0, 0.0);
    walker.arrive(starts_s - 120.0);
    walker.go({side * 88.0, walker.at.y < 0.0 ? -44.0 : 44.0, 0.0}, kWalkMps * 2.0);
    walker.go(hoist, kWalkMps * 2.0);
    for (int stay = 0; stay < 3 && storey < kStoreys; ++stay) {
        walker.go({hoist.x, hoist.y, storey * kStoreyM}, kRideMps);
        for (int spot = 0; spot < 2; ++spot) {
            walker.go(place_in_storey(storey, builder), kWalkMps);
            walker.wait(builder.rng.between(15.0, 60.0));
        }
        walker.go({hoist.x, hoist.y, storey * kStoreyM}, kWalkMps);
        storey += 1 + static_cast<int>(builder.rng.below(6));
    }
}

/// Works on the ground: a few places around the plaza.
void work_outside(Walker& walker, SceneBuilder& builder) {
    walker.arrive(builder.rng.between(-200.0, kEndS - 120.0));
    for (int spot = 0; spot < 5; ++spot) {
        const double radius_m = builder.rng.between(46.0, 86.0), angle_rad = builder.rng.between(0.0, 6.28);
        const glm::dvec3 to(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), 0.0);
        if (glm::length(to - walker.at) < 110.0) walker.go(to, kWalkMps);
        walker.wait(builder.rng.between(10.0, 90.0));
    }
    walker.go(walker.at + glm::dvec3(0.6, 0.4, 0.0), kWalkMps);
}

}  // namespace

void add_crew(int count, SceneBuilder& builder) {
    const std::array<uint32_t, 4> meshes = {add_mesh(make_person({226, 118, 36}, kWhite), builder),
                                            add_mesh(make_person({206, 206, 60}, kYellow), builder),
                                            add_mesh(make_person({226, 118, 36}, {62, 110, 168}), builder),
                                            add_mesh(make_person({206, 206, 60}, kWhite), builder)};
    for (int i = 0; i < count; ++i) {
        Walker walker;
        walker.at = camp_place(i);
        walker.keys = {key_at(0.0, {walker.at, builder.rng.between(0.0, 6.28)})};
        if (builder.rng.below(5) < 3) {
            work_in_tower(walker, builder);
        } else {
            work_outside(walker, builder);
        }
        Presence presence{Presence::kNever, walker.time_s + 10.0};
        if (walker.keys[0].time_s > 1.0) presence.appears_s = walker.keys[0].time_s - 1.0;
        add_mover("worker", meshes[builder.rng.below(meshes.size())], walker.keys, presence, builder);
    }
}

}  // namespace data::site
