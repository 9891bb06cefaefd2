#include "data/scenes/site_fleet.h"

#include <array>
#include <cmath>

#include "data/scenes/site_meshes.h"
#include "data/scenes/site_plan.h"
#include "data/scenes/site_route.h"

namespace data::site {

namespace {

constexpr double kQuarterRad = std::numbers::pi / 2.0;
constexpr int kMixers = 120, kDumpers = 160, kFlatbeds = 140, kExcavators = 60;
constexpr int kRows = 4, kPerRow = 27, kSides = 4;
constexpr double kSpotM = 5.6, kFirstRowM = 116.0, kRowM = 20.0;
constexpr double kAisleM = 10.0;  // in front of each row

/// A part and where it is on the vehicle: front +y, ground z = 0.
struct Part {
    const char* kind;
    uint32_t mesh;
    Placement in_vehicle;
};
using Parts = std::vector<Part>;

uint32_t wheel_mesh(SceneBuilder& builder) {
    TimedMesh mesh;
    append_tube({{-0.18, 0, 0}, {0.18, 0, 0}, 0.52, 12}, kRubber, mesh);
    append_tube({{-0.22, 0, 0}, {0.22, 0, 0}, 0.2, 5}, kAluminium, mesh);
    return add_mesh(std::move(mesh), builder);
}

uint32_t cab_mesh(const Colour& paint, SceneBuilder& builder) {
    TimedMesh mesh;
    append_box({-1.2, 0.0, 0.7}, {1.2, 1.9, 1.7}, paint, mesh);
    append_box({-1.15, 0.1, 1.7}, {1.15, 1.8, 2.8}, paint, mesh);
    append_box({-1.0, 1.8, 1.75}, {1.0, 1.84, 2.7}, {48, 66, 82}, mesh);
    for (const double x : {-1.19, 1.15})
        append_box({x, 0.6, 1.75}, {x + 0.04, 1.6, 2.6}, {48, 66, 82}, mesh);
    append_box({-1.2, 1.9, 0.5}, {1.2, 2.05, 0.9}, kSteel, mesh);
    for (const double x : {-1.45, 1.2})
        append_box({x, 1.5, 1.8}, {x + 0.25, 1.6, 2.4}, kRubber, mesh);
    return add_mesh(std::move(mesh), builder);
}

uint32_t chassis_mesh(double length_m, SceneBuilder& builder) {
    TimedMesh mesh;
    for (const double x : {-0.55, 0.4})
        append_box({x, -length_m, 0.55}, {x + 0.15, 1.8, 0.85}, kSteel, mesh);
    append_box({-0.9, -1.6, 0.5}, {-0.55, -0.4, 1.0}, kAluminium, mesh);
    append_box({0.55, -1.6, 0.5}, {0.9, -0.4, 1.0}, kAluminium, mesh);
    append_box({-1.15, -length_m, 0.6}, {1.15, -length_m + 0.15, 0.9}, kSteel, mesh);
    return add_mesh(std::move(mesh), builder);
}

void append_wheels(uint32_t wheel, std::initializer_list<double> axles, Parts& parts) {
    for (const double y : axles) {
        for (const double x : {-1.0, 1.0})
            parts.push_back({"wheel", wheel, {{x, y, 0.52}}});
    }
}

Parts make_mixer(uint32_t wheel, SceneBuilder& builder) {
    TimedMesh drum;
    append_tube({{0, -0.4, 1.7}, {0, -2.0, 2.1}, 0.95, 14}, kWhite, drum);
    append_tube({{0, -2.0, 2.1}, {0, -3.8, 2.5}, 1.15, 14}, {58, 112, 158}, drum);
    append_tube({{0, -3.8, 2.5}, {0, -5.4, 2.9}, 0.8, 14}, kWhite, drum);
    append_tube({{0, -5.4, 2.9}, {0, -5.7, 2.97}, 0.5, 14}, kSteel, drum);
    append_bar({{-0.3, -5.6, 2.6}, {-0.3, -6.6, 1.4}, 0.4, 0.1}, kSteel, drum);
    append_box({-0.9, -5.3, 0.85}, {0.9, -5.0, 2.1}, kSteel, drum);
    Parts parts = {{"mixer", chassis_mesh(6.0, builder), {}},
                   {"cab", cab_mesh({58, 112, 158}, builder), {}},
                   {"drum", add_mesh(std::move(drum), builder), {}}};
    append_wheels(wheel, {0.9, -3.6, -4.9}, parts);
    return parts;
}

Parts make_dumper(uint32_t wheel, SceneBuilder& builder) {
    TimedMesh bed;
    append_box({-1.25, -5.6, 0.9}, {1.25, -0.5, 1.1}, kSafety, bed);
    for (const double x : {-1.25, 1.15})
        append_box({x, -5.6, 1.1}, {x + 0.1, -0.5, 2.1}, kSafety, bed);
    append_box({-1.25, -0.6, 1.1}, {1.25, -0.5, 2.4}, kSafety, bed);
    append_box({-1.25, -0.5, 2.4}, {1.25, 0.9, 2.5}, kSafety, bed);
    Parts parts = {{"dumper", chassis_mesh(5.6, builder), {}},
                   {"cab", cab_mesh(kSafety, builder), {}},
                   {"bed", add_mesh(std::move(bed), builder), {}}};
    append_wheels(wheel, {0.9, -3.4, -4.7}, parts);
    return parts;
}

Parts make_flatbed(uint32_t wheel, SceneBuilder& builder) {
    TimedMesh deck;
    append_box({-1.25, -10.2, 1.0}, {1.25, -0.4, 1.2}, kPlywood, deck);
    append_box({-1.25, -0.5, 1.2}, {1.25, -0.4, 2.2}, kSteel, deck);
    append_box({-0.5, -8.0, 0.7}, {0.5, -2.0, 1.0}, kSteel, deck);
    const uint32_t panel = add_mesh(make_facade({72, 110, 138}), builder);
    Parts parts = {{"flatbed", chassis_mesh(10.0, builder), {}},
                   {"cab", cab_mesh({178, 62, 50}, builder), {}},
                   {"deck", add_mesh(std::move(deck), builder), {}}};
    for (const double y : {-2.4, -5.2, -8.0})
        parts.push_back({"freight", panel, {{0.0, y, 1.5}, kQuarterRad}});
    append_wheels(wheel, {0.9, -4.0, -7.6, -8.9}, parts);
    return parts;
}

/// A parking spot beyond the ring road: +y of `frame` points to the site, x along its side.
struct ParkingSpot {
    Placement frame;
    glm::dvec2 place;  ///< in the frame
};

ParkingSpot parking_spot(int number) {
    const int side = number % kSides, place = number / kSides;
    const int row = place / kPerRow % kRows, col = place % kPerRow;
    return {{{}, side * kQuarterRad}, {kSpotM * (col - (kPerRow - 1) / 2.0), -kFirstRowM - kRowM * row}};
}

/// A visit to the site: from a parking spot by the aisle and the ring road to a place of work, and back.
struct Visit {
    std::vector<KeyFrame> keys;
    Presence presence;
};

std::vector<glm::dvec2> make_way(int number, SceneBuilder& builder) {
    const ParkingSpot spot = parking_spot(number);
    const auto in_site = [&](double x, double y) {
        return glm::dvec2((spot.frame * Placement{{x, y, 0.0}}).position);
    };
    const double lane = kRoadM + builder.rng.between(-3.0, 3.0), work = builder.rng.between(-60.0, 60.0);
    const double aisle_y = spot.place.y + kAisleM, side = number % 8 < kSides ? -1.0 : 1.0;
    std::vector<glm::dvec2> way = {in_site(spot.place.x, spot.place.y), in_site(spot.place.x, aisle_y)};
    if (builder.rng.below(2) == 0) {  // to the next side of the site, or to its own
        way.push_back(in_site(side * lane, aisle_y));
        way.push_back(in_site(side * lane, work));
    } else {
        way.push_back(in_site(side * 86.0, aisle_y));
        way.push_back(in_site(side * 86.0, -lane));
        way.push_back(in_site(work, -lane));
    }
    return way;
}

Visit make_visit(int number, SceneBuilder& builder) {
    const ParkingSpot spot = parking_spot(number);
    const KeyFrame parked = key_at(0.0, spot.frame * Placement{{spot.place, 0.0}});
    const std::vector<glm::dvec2> out = make_way(number, builder);
    std::vector<glm::dvec2> back(out.rbegin(), out.rend());
    back.back() = glm::dvec2((spot.frame * Placement{{spot.place.x, spot.place.y - 4.5, 0.0}}).position);

    Visit visit;
    const double comes_s = builder.rng.between(-300.0, kEndS - 420.0);
    double time_s = std::max(comes_s, 0.0) + builder.rng.between(20.0, 180.0);
    const auto stand = [&](const KeyFrame& pose) {
        visit.keys.push_back(pose);
        visit.keys.back().time_s = time_s;
    };
    stand(parked);
    time_s = append_drive(out, {time_s + 0.1, 9.0}, visit.keys) + builder.rng.between(20.0, 60.0);
    stand(visit.keys.back());
    time_s = append_drive(back, {time_s + 3.0, 9.0}, visit.keys) + 6.0;
    stand(parked);
    if (comes_s > 0.0) visit.presence.appears_s = comes_s;
    visit.presence.disappears_s = time_s + builder.rng.between(20.0, 180.0);
    return visit;
}

void add_vehicle(const Parts& parts, const Visit& visit, SceneBuilder& builder) {
    for (const Part& part : parts)
        add_mover(part.kind, part.mesh, carried(visit.keys, part.in_vehicle), visit.presence, builder);
}

/// An excavator's parts in a chain: each turns in the one before.
struct ExcavatorMeshes {
    uint32_t track, house, boom, stick, bucket;
};

ExcavatorMeshes make_excavator(SceneBuilder& builder) {
    TimedMesh track, house, boom, stick, bucket;
    append_box({-0.3, -1.4, 0.1}, {0.3, 1.4, 0.9}, kRubber, track);
    append_tube({{-0.32, -1.4, 0.5}, {0.32, -1.4, 0.5}, 0.45, 9}, kSteel, track);
    append_tube({{-0.32, 1.4, 0.5}, {0.32, 1.4, 0.5}, 0.45, 9}, kSteel, track);
    append_box({-1.3, -2.2, 1.1}, {1.3, 1.0, 1.5}, kYellow, house);
    append_box({-1.3, -2.2, 1.5}, {1.3, -0.4, 2.3}, kYellow, house);
    append_box({-1.3, -0.3, 1.5}, {-0.3, 1.3, 2.9}, kYellow, house);
    append_box({-1.25, 1.3, 1.7}, {-0.35, 1.33, 2.8}, {48, 66, 82}, house);
    append_box({-1.2, -2.5, 1.2}, {1.2, -2.2, 2.0}, kSteel, house);
    append_tube({{0, 0, 0.9}, {0, 0, 1.1}, 0.8, 7}, kSteel, house);
    append_bar({{0, 0, 0}, {0, 3.0, 2.2}, 0.35, 0.5}, kYellow, boom);
    append_bar({{0, 3.0, 2.2}, {0, 5.4, 2.0}, 0.32, 0.42}, kYellow, boom);
    append_bar({{0, 0.6, 0.0}, {0, 2.8, 1.7}, 0.15, 0.15}, kSteel, boom);
    append_bar({{0, 0.4, 0.3}, {0, -2.6, -1.2}, 0.26, 0.34}, kYellow, stick);
    append_bar({{0, -0.4, 0.4}, {0, 0.3, 0.3}, 0.14, 0.14}, kSteel, stick);
    append_box({-0.6, -0.9, -0.9}, {0.6, -0.8, 0.1}, kSteel, bucket);
    append_box({-0.6, -0.9, -0.9}, {0.6, 0.0, -0.8}, kSteel, bucket);
    for (const double x : {-0.6, 0.55})
        append_box({x, -0.85, -0.85}, {x + 0.05, -0.1, 0.05}, kSteel, bucket);
    append_box({-0.6, 0.0, -0.95}, {0.6, 0.2, -0.9}, kSteel, bucket);
    return {add_mesh(std::move(track), builder), add_mesh(std::move(house), builder),
            add_mesh(std::move(boom), builder), add_mesh(std::move(stick), builder),
            add_mesh(std::move(bucket), builder)};
}

glm::dquat about_x(double angle_rad) {
    return {std::cos(angle_rad / 2.0), std::sin(angle_rad / 2.0), 0.0, 0.0};
}

/// Digs, turns, empties, turns back, and moves on a little after every load.
void add_excavator(const ExcavatorMeshes& meshes, const Placement& place, double begins_s,
                   SceneBuilder& builder) {
    constexpr int kLoads = 7;
    std::array<std::vector<KeyFrame>, 6> keys;
    double time_s = begins_s;
    const double turn_rad = builder.rng.between(1.2, 2.6);
    for (int load = 0; load < kLoads; ++load) {
        const Placement stand = place * Placement{{0.0, 0.25 * load, 0.0}};
        for (int phase = 0; phase < 4; ++phase) {  // down, up, round, emptied
            const double slew_rad = phase < 2 ? 0.0 : turn_rad;
            const double boom_rad = phase == 0 ? -0.45 : 0.12, stick_rad = phase == 0   ? 0.7
                                                                           : phase == 3 ? -0.5
                                                                                        : 0.25;
            const KeyFrame house = key_at(time_s, stand * Placement{{}, slew_rad});
            const glm::dvec3 foot = house.position + house.rotation * glm::dvec3(0.35, 0.6, 1.7);
            const glm::dquat boom = house.rotation * about_x(boom_rad), stick = boom * about_x(stick_rad);
            const glm::dvec3 elbow = foot + boom * glm::dvec3(0.0, 5.2, 2.0);
            const glm::dvec3 wrist = elbow + stick * glm::dvec3(0.0, -2.5, -1.15);
            keys[0].push_back(key_at(time_s, stand * Placement{{-1.0, 0.0, 0.0}}));
            keys[1].push_back(key_at(time_s, stand * Placement{{1.0, 0.0, 0.0}}));
            keys[2].push_back(house);
            keys[3].push_back({time_s, foot, boom});
            keys[4].push_back({time_s, elbow, stick});
            keys[5].push_back({time_s, wrist, stick * about_x(phase == 3 ? -0.9 : 0.3)});
            time_s += phase == 3 ? 6.0 : 4.0;
        }
    }
    const Presence presence{begins_s - 10.0, time_s + 10.0};
    const uint32_t chain[] = {meshes.track, meshes.track, meshes.house,
                              meshes.boom,  meshes.stick, meshes.bucket};
    for (size_t part = 0; part < keys.size(); ++part)
        add_mover("excavator", chain[part], keys[part], presence, builder);
}

void add_excavators(SceneBuilder& builder) {
    const ExcavatorMeshes meshes = make_excavator(builder);
    for (int i = 0; i < kExcavators; ++i) {
        const bool is_in_pit = i % 3 == 0;  // those have left before the raft is poured
        const double radius_m = is_in_pit ? 8.0 + 1.4 * i / 3.0 : 205.0 + 2.0 * (i % 9);
        const double angle_rad = 2.4 * i;
        const glm::dvec3 at(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad),
                            is_in_pit ? kPitFloorM : 0.0);
        const double begins_s =
            is_in_pit ? kClearedS + builder.rng.between(70.0, 90.0) : builder.rng.between(20.0, 3300.0);
        add_excavator(meshes, {at, builder.rng.between(0.0, 6.28)}, begins_s, builder);
    }
}

}  // namespace

std::vector<Bed> add_fleet(SceneBuilder& builder) {
    const uint32_t wheel = wheel_mesh(builder);
    const Parts mixer = make_mixer(wheel, builder), dumper = make_dumper(wheel, builder),
                flatbed = make_flatbed(wheel, builder);
    std::vector<Bed> beds;
    for (int number = 0; number < kMixers + kDumpers + kFlatbeds; ++number) {
        const Visit visit = make_visit(number, builder);
        const bool is_dumper = number >= kMixers && number < kMixers + kDumpers;
        add_vehicle(is_dumper ? dumper : number < kMixers ? mixer : flatbed, visit, builder);
        if (is_dumper) beds.push_back({carried(visit.keys, {{0.0, -3.0, 1.1}}), visit.presence});
    }
    add_excavators(builder);
    return beds;
}

}  // namespace data::site
