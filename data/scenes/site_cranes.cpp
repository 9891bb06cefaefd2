#include "data/scenes/site_cranes.h"

#include <algorithm>
#include <cmath>

#include "data/scenes/site_meshes.h"
#include "data/scenes/site_plan.h"

namespace data::site {

namespace {

constexpr double kQuarterRad = std::numbers::pi / 2.0;
constexpr double kRunUpM = 30.0;    // how far a jib is above the highest floor, at least
constexpr double kRiggedS = 375.0;  // when the jibs are put up
constexpr double kFirstLiftS = 400.0, kLiftS = 31.0;
constexpr int kLifts = 66, kPartsPerRack = 12;
constexpr int kJibSections = 9, kRopes = 23;
constexpr double kRopeM = 12.0;
constexpr double kHungM = 5.0;                          // from the hook to the foot of what hangs on it
constexpr double kMaxTurnRad = std::numbers::pi / 6.0;  // between two key frames

/// What a crane does at an instant. Its frame: x outwards from the tower, at the mast.
struct Moment {
    double time_s = 0.0;
    double turn_rad = 0.0;  ///< of the jib, from +x
    double reach_m = 0.0;   ///< of the trolley
    double hook_m = 0.0;    ///< above ground
};

Placement crane_frame(int crane) {
    return {mast_foot(crane) * glm::dvec3(1, 1, 0), crane * kQuarterRad};
}

double jib_m(double time_s) {
    const double highest_m = kPitFloorM + kMastSections * kSectionM;
    const double grown_m = std::min(highest_m, tower_top_m(time_s) + kRunUpM);
    const double lowered_m = highest_m - std::max(0.0, time_s - kDismantleS) * kSectionM / 2.5;
    return std::max(2.0, std::min(grown_m, lowered_m));
}

/// One rack and where it goes: slot in the yard, landing on the floor that is built then.
struct Lift {
    double begins_s = 0.0;
    Moment slot, landing;
};

/// Adds moments of a swing from the last one to `to`, at even angles.
void swing(const Moment& to, std::vector<Moment>& moments) {
    const Moment from = moments.back();
    const int steps =
        std::max(1, static_cast<int>(std::ceil(std::abs(to.turn_rad - from.turn_rad) / kMaxTurnRad)));
    for (int i = 1; i <= steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        moments.push_back(
            {glm::mix(from.time_s, to.time_s, share), glm::mix(from.turn_rad, to.turn_rad, share),
             glm::mix(from.reach_m, to.reach_m, share), glm::mix(from.hook_m, to.hook_m, share)});
    }
}

Moment moment_at(const glm::dvec2& in_frame, double time_s, double hook_m) {
    double turn_rad = std::atan2(in_frame.y, in_frame.x);
    if (turn_rad < -kQuarterRad)
        turn_rad += 4.0 * kQuarterRad;  // over the tower all angles are near +180 degrees
    return {time_s, turn_rad, glm::length(in_frame), hook_m};
}

/// The slots of a crane's yard lie in twelve rows of eight; the landing is somewhere on the floor.
Lift make_lift(int number, SceneBuilder& builder) {
    Lift lift;
    lift.begins_s = kFirstLiftS + kLiftS * number;
    const int slot = number * 37 % 96;  // 37 and 96 have no common factor: no slot twice
    lift.slot = moment_at({12.5 + 4.0 * (slot % 8), 4.0 * (slot / 8) - 22.0}, lift.begins_s, kHungM);
    const double radius_m = builder.rng.between(2.0, 16.0),
                 angle_rad = builder.rng.between(0.0, 4.0 * kQuarterRad);
    const glm::dvec2 floor(radius_m * std::cos(angle_rad) - kMastM, radius_m * std::sin(angle_rad));
    lift.landing = moment_at(floor, lift.begins_s + 17.0, tower_top_m(lift.begins_s + 17.0) + kHungM);
    return lift;
}

/// The way of the hook with its rack: up, round, down.
std::vector<Moment> carry(const Lift& lift) {
    const double high_m = lift.landing.hook_m + 8.0;
    std::vector<Moment> moments = {lift.slot};
    Moment above = lift.slot;
    above.time_s += 5.0;
    above.hook_m = high_m;
    moments.push_back(above);
    above = lift.landing;
    above.time_s -= 3.0;
    above.hook_m = high_m;
    swing(above, moments);
    moments.push_back(lift.landing);
    return moments;
}

/// Back from one landing to the next slot.
void go_back(const Lift& next, double high_m, std::vector<Moment>& moments) {
    Moment above = moments.back();
    above.time_s += 3.0;
    above.hook_m = high_m;
    moments.push_back(above);
    above = next.slot;
    above.time_s -= 4.0;
    above.hook_m = high_m;
    swing(above, moments);
}

Placement under_trolley(const Moment& moment, double z_m) {
    const double x = moment.reach_m * std::cos(moment.turn_rad),
                 y = moment.reach_m * std::sin(moment.turn_rad);
    return {{x, y, z_m}, moment.turn_rad};
}

TimedMesh make_jib_section() {
    TimedMesh mesh;
    const double length = 6.0;
    for (const double y : {-0.7, 0.7})
        append_bar({{0, y, 0}, {length, y, 0}, 0.14, 0.14}, kYellow, mesh);
    append_bar({{0, 0, 1.3}, {length, 0, 1.3}, 0.14, 0.14}, kYellow, mesh);
    for (const double y : {-0.7, 0.7}) {
        append_bar({{0, y, 0}, {3, 0, 1.3}, 0.07, 0.07}, kYellow, mesh);
        append_bar({{3, 0, 1.3}, {6, y, 0}, 0.07, 0.07}, kYellow, mesh);
    }
    append_bar({{0, -0.7, 0}, {0, 0.7, 0}, 0.07, 0.07}, kYellow, mesh);
    append_bar({{3, -0.7, 0}, {3, 0.7, 0}, 0.07, 0.07}, kYellow, mesh);
    return mesh;
}

/// What turns with the jib besides its sections: counter jib, ballast, cab, tower head with its stays.
std::vector<TimedMesh> make_superstructure() {
    std::vector<TimedMesh> parts(4);
    append_box({-16, -0.8, -0.2}, {0, 0.8, 0.0}, kYellow, parts[0]);
    for (const double y : {-0.8, 0.8})
        append_box({-16, y - 0.05, 0.9}, {0, y + 0.05, 1.0}, kYellow, parts[0]);
    for (const double x : {-15.0, -13.6, -12.2})
        append_box({x - 0.6, -0.9, -2.2}, {x + 0.6, 0.9, 0.0}, kConcrete, parts[1]);
    append_box({0.8, 1.0, -2.0}, {3.0, 2.6, 0.2}, kWhite, parts[2]);
    append_box({1.0, 1.1, -1.4}, {3.05, 2.5, -0.2}, {60, 84, 104}, parts[2]);
    for (const double y : {-0.7, 0.7})
        append_bar({{0, y, 0}, {0, 0, 9.0}, 0.2, 0.2}, kYellow, parts[3]);
    append_bar({{0, 0, 9.0}, {36, 0, 1.3}, 0.06, 0.06}, kSteel, parts[3]);
    append_bar({{0, 0, 9.0}, {-14, 0, 0.0}, 0.06, 0.06}, kSteel, parts[3]);
    append_box({-1.2, -1.2, -1.2}, {1.2, 1.2, 0.0}, kSteel, parts[3]);
    return parts;
}

/// Meshes that all cranes share.
struct CraneMeshes {
    uint32_t jib, trolley, hook, rope;
    std::vector<uint32_t> superstructure, loads;
};

CraneMeshes make_crane_meshes(SceneBuilder& builder) {
    CraneMeshes meshes{};
    meshes.jib = add_mesh(make_jib_section(), builder);
    for (TimedMesh& part : make_superstructure())
        meshes.superstructure.push_back(add_mesh(std::move(part), builder));
    TimedMesh trolley, hook, rope;
    append_box({-1.0, -0.8, -0.5}, {1.0, 0.8, -0.2}, kSteel, trolley);
    append_tube({{0, -0.9, -0.3}, {0, 0.9, -0.3}, 0.3, 6}, kRubber, trolley);
    append_box({-0.5, -0.2, 0.0}, {0.5, 0.2, 1.2}, kYellow, hook);
    append_tube({{0, 0, -0.8}, {0, 0, 0}, 0.12, 6}, kSteel, hook);
    append_tube({{0, 0, 0}, {0, 0, kRopeM}, 0.05, 5}, kRubber, rope);
    meshes.trolley = add_mesh(std::move(trolley), builder);
    meshes.hook = add_mesh(std::move(hook), builder);
    meshes.rope = add_mesh(std::move(rope), builder);
    meshes.loads = {add_mesh(make_facade({62, 98, 128}), builder), add_mesh(make_beam(), builder),
                    add_mesh(make_rebar(), builder)};
    return meshes;
}

/// The parts of one rack: panels stand in two rows, beams and mats lie on one another.
void add_rack(const Lift& lift, const std::vector<Moment>& way, const Placement& frame,
              const CraneMeshes& meshes, SceneBuilder& builder) {
    const uint64_t kind = builder.rng.below(5) % 3;  // panels and beams twice as often as mats
    const Presence presence{lift.begins_s - builder.rng.between(40.0, 220.0), way.back().time_s};
    for (int part = 0; part < kPartsPerRack; ++part) {
        Placement in_rack;
        if (kind == 0) in_rack.position = {-1.5 + 1.5 * (part % 3), 0.6 * (part / 3) - 0.9, 0.3 - kHungM};
        if (kind == 1) in_rack.position = {0.0, 0.45 * (part % 4) - 0.7, 0.7 * (part / 4) + 0.95 - kHungM};
        if (kind == 2) in_rack.position = {0.0, 0.0, 0.16 * part + 0.1 - kHungM};
        std::vector<KeyFrame> keys;
        for (const Moment& moment : way) {
            Placement hung = under_trolley(moment, moment.hook_m);
            keys.push_back(key_at(moment.time_s, frame * (hung * in_rack)));
        }
        const char* kinds[] = {"panel", "bundle", "mat"};
        add_mover(kinds[kind], meshes.loads[kind], keys, presence, builder);
    }
}

/// Everything of one crane that moves, for all its moments.
void add_crane(const std::vector<Moment>& moments, const Placement& frame, const CraneMeshes& meshes,
               SceneBuilder& builder) {
    const Presence presence{kRiggedS, mast_section_disappears_s(0)};
    const auto add = [&](const char* kind, uint32_t mesh, const auto& placement_at) {
        std::vector<KeyFrame> keys;
        for (const Moment& moment : moments)
            keys.push_back(key_at(moment.time_s, frame * placement_at(moment)));
        add_mover(kind, mesh, keys, presence, builder);
    };
    const auto slewed = [&](double x) {
        return [x](const Moment& m) {
            return Placement{{0, 0, jib_m(m.time_s)}, m.turn_rad} * Placement{{x, 0, 0}};
        };
    };
    for (int section = 0; section < kJibSections; ++section)
        add("jib", meshes.jib, slewed(6.0 * section));
    for (const uint32_t part : meshes.superstructure)
        add("crane", part, slewed(0.0));
    add("trolley", meshes.trolley, [](const Moment& m) { return under_trolley(m, jib_m(m.time_s)); });
    add("hook", meshes.hook, [](const Moment& m) { return under_trolley(m, m.hook_m); });
    for (int rope = 0; rope < kRopes; ++rope) {  // as a telescope: those above the hook hide in one another
        add("rope", meshes.rope, [rope](const Moment& m) {
            const double low_m = jib_m(m.time_s) - 0.5 - kRopeM * (rope + 1);
            return under_trolley(m, std::max(m.hook_m + 1.2, low_m));
        });
    }
}

}  // namespace

glm::dvec3 mast_foot(int crane) {
    return (Placement{{}, crane * kQuarterRad} * Placement{{kMastM, 0.0, kPitFloorM}}).position;
}

double mast_section_appears_s(int crane, int section) {
    const double top_m = kPitFloorM + kSectionM * (section + 1);
    return std::max(330.0 + 4.0 * section + 2.0 * crane, time_of_height(top_m - kRunUpM));
}

double mast_section_disappears_s(int section) {
    return kDismantleS + 2.5 * (kMastSections - section);
}

void add_cranes(SceneBuilder& builder) {
    const CraneMeshes meshes = make_crane_meshes(builder);
    for (int crane = 0; crane < kCranes; ++crane) {
        const Placement frame = crane_frame(crane);
        std::vector<Moment> moments;
        for (int number = 0; number < kLifts; ++number) {
            const Lift lift = make_lift(number, builder);
            const std::vector<Moment> way = carry(lift);
            if (number > 0) go_back(lift, way[1].hook_m, moments);
            moments.insert(moments.end(), way.begin(), way.end());
            add_rack(lift, way, frame, meshes, builder);
        }
        Moment parked = moments.back();
        parked.time_s = kDismantleS;
        parked.hook_m += 10.0;
        moments.push_back(parked);
        parked.time_s = mast_section_disappears_s(0);
        parked.hook_m = 0.0;
        moments.push_back(parked);
        add_crane(moments, frame, meshes, builder);
    }
}

}  // namespace data::site
