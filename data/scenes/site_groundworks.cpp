#include "data/scenes/site_groundworks.h"

#include "data/scenes/site_cranes.h"
#include "data/scenes/site_meshes.h"
#include "data/scenes/site_plan.h"
#include "data/scenes/trade.h"

namespace data::site {

namespace {

constexpr double kQuarterRad = std::numbers::pi / 2.0;
constexpr double kPodiumS = 2890.0;                                      // begun when the last mast is down
constexpr double kPodiumStorey = (kPodiumS - kFirstStoreyS) / kStoreyS;  // as a storey's time

/// Work on the ground that is done once, from one time to another, in the order of a curve.
struct Job {
    const char* kind;
    double begins_s, ends_s;
};

std::vector<Spot> ordered(std::vector<Spot> spots) {
    order_along_curve(spots);
    return spots;
}

void add_job(const Job& job, const std::vector<Spot>& spots, SceneBuilder& builder) {
    for (const Spot& spot : ordered(spots))
        add_object(job.kind, spot.mesh, spot.in_storey,
                   {job.begins_s + (job.ends_s - job.begins_s) * spot.order}, builder);
}

/// Places on a grid of `count` by `count` cells over the square of half side `half_m`.
std::vector<Spot> grid(uint32_t mesh, int count, double half_m, double z_m) {
    std::vector<Spot> spots;
    for (int row = 0; row < count; ++row) {
        for (int col = 0; col < count; ++col) {
            const auto at = [&](int i) { return half_m * (2.0 * (i + 0.5) / count - 1.0); };
            spots.push_back({{{at(col), at(row), z_m}}, mesh});
        }
    }
    return spots;
}

bool is_under_tower(const Spot& spot) {
    const glm::dvec3& p = spot.in_storey.position;
    return std::abs(p.x) < kHalfTowerM && std::abs(p.y) < kHalfTowerM;
}

/// The podium's trades; x from -42 to 42, y from -42 to -21.
std::vector<Trade> podium_trades(SceneBuilder& builder) {
    const uint32_t slab = add_mesh(make_slab(), builder), beam = add_mesh(make_beam(), builder);
    const uint32_t column = add_mesh(make_column({0.0, 0.0}), builder);
    const uint32_t panel = add_mesh(make_facade({96, 132, 140}), builder);
    Trade slabs{"slab", {}, 0.0, 1.5, 0.0}, beams{"beam", {}, 0.2, 1.5, 0.0},
        columns{"column", {}, 0.6, 1.5, 0.0};
    Trade facade{"facade", {}, 3.0, 2.0, 0.0};
    const auto at = [](double col, double row, double turn_rad) {
        return Placement{{kBayM * (col - 6.0), kBayM * (row - 6.0), kStoreyM}, turn_rad};
    };
    for (int row = 0; row <= 3; ++row) {
        for (int col = 0; col <= 12; ++col) {
            if (row < 3 && col < 12) slabs.spots.push_back({at(col + 0.5, row + 0.5, 0.0), slab});
            if (col < 12) beams.spots.push_back({at(col + 0.5, row, 0.0), beam});
            if (row < 3) beams.spots.push_back({at(col, row + 0.5, kQuarterRad), beam});
            Placement node = at(col, row, 0.0);
            node.position.z = 0.0;
            columns.spots.push_back({node, column});
        }
    }
    const auto add_panels = [&](int bays, const auto& place) {
        for (int i = 0; i < 4 * bays; ++i) {
            Placement panel_place = place((i + 0.5) / 4.0);
            panel_place.position.z = 0.0;
            facade.spots.push_back({panel_place, panel});
        }
    };
    add_panels(12, [&](double along) { return at(along, 0.0, 0.0); });
    add_panels(12, [&](double along) { return at(along, 3.0, 2.0 * kQuarterRad); });
    add_panels(3, [&](double along) { return at(12.0, along, kQuarterRad); });
    add_panels(3, [&](double along) { return at(0.0, along, -kQuarterRad); });
    std::vector<Trade> trades = {slabs, beams, columns, facade};
    for (Trade& trade : trades)
        order_along_curve(trade.spots);
    return trades;
}

void add_scaffold(SceneBuilder& builder) {
    const uint32_t mesh = add_mesh(make_scaffold(), builder);
    for (int level = 0; level < 2; ++level) {
        const auto add = [&](double x, double y, double turn_rad) {
            const double appears_s = kPodiumS + 30.0 * level + builder.rng.between(0.0, 30.0);
            const Presence presence{appears_s, 3240.0 + builder.rng.between(0.0, 60.0)};
            add_object("scaffold", mesh, {{x, y, 4.2 * level}, turn_rad}, presence, builder);
        };
        for (int i = 0; i < 12; ++i) {
            const double x = kBayM * (i - 5.5);
            add(x, -kHalfPitM - 1.2, 0.0);
            add(x, -kHalfTowerM + 1.2, 2.0 * kQuarterRad);
        }
        for (int i = 0; i < 3; ++i) {
            const double y = kBayM * (i - 5.5);
            add(kHalfPitM + 1.2, y, kQuarterRad);
            add(-kHalfPitM - 1.2, y, -kQuarterRad);
        }
    }
}

}  // namespace

void add_groundworks(SceneBuilder& builder) {
    TimedMesh pile, raft, lining, earth;
    append_tube({{0, 0, 0}, {0, 0, 2.5}, 0.5, 12}, kConcrete, pile);
    append_box({-5.24, -5.24, 0.0}, {5.24, 5.24, 1.9}, kPaleConcrete, raft);
    append_box({-1.3, -0.3, 0.0}, {1.3, 0.0, -kPitFloorM}, kRust, lining);
    append_box({-1.3, -0.5, -kPitFloorM - 1.5}, {1.3, -0.3, -kPitFloorM - 1.0}, kSteel, lining);
    append_box({-3.5, -3.5, kPitFloorM + 0.05}, {3.5, 3.5, 0.0}, kSand, earth);
    const uint32_t earth_mesh = add_mesh(std::move(earth), builder);
    for (const Spot& block : ordered(grid(earth_mesh, 12, kHalfPitM, 0.0))) {  // dug out
        const Presence presence{Presence::kNever, kClearedS + 20.0 + 90.0 * block.order};
        add_object("earth", block.mesh, block.in_storey, presence, builder);
    }
    std::vector<Spot> walls;
    const uint32_t wall = add_mesh(std::move(lining), builder);
    for (int side = 0; side < 4; ++side) {
        for (int i = 0; i < 32; ++i) {
            const Placement along{{kHalfPitM * (2.0 * (i + 0.5) / 32 - 1.0), kHalfPitM, kPitFloorM}};
            walls.push_back({Placement{{}, side * kQuarterRad} * along, wall});
        }
    }
    add_job({"lining", kClearedS, kClearedS + 80.0}, std::move(walls), builder);
    add_job({"pile", 240.0, 310.0}, grid(add_mesh(std::move(pile), builder), 18, kHalfPitM - 2.0, kPitFloorM),
            builder);
    add_job({"raft", 300.0, 335.0}, grid(add_mesh(std::move(raft), builder), 8, kHalfPitM - 0.05, kPitFloorM),
            builder);
    std::vector<Spot> plaza = grid(add_mesh(make_slab(), builder), 12, kHalfPitM, 0.0);
    std::erase_if(plaza, is_under_tower);
    add_job({"slab", 420.0, 720.0}, std::move(plaza), builder);
}

void add_masts(SceneBuilder& builder) {
    const uint32_t section = add_mesh(make_mast(), builder), hoist = add_mesh(make_hoist_mast(), builder);
    for (int crane = 0; crane < kCranes; ++crane) {
        for (int i = 0; i < kMastSections; ++i) {
            glm::dvec3 foot = mast_foot(crane);
            foot.z += kSectionM * i;
            const Presence presence{mast_section_appears_s(crane, i), mast_section_disappears_s(i)};
            add_object("mast", section, {foot}, presence, builder);
        }
    }
    for (const double x : {-26.0, 26.0}) {  // beside the lowest storeys, tied to the higher ones
        for (int i = 0; i < kStoreys; ++i) {
            const Presence presence{storey_time(i + 2.0), 3150.0 + 2.0 * (kStoreys - i)};
            add_object("hoistmast", hoist, {{x, x < 0.0 ? 19.0 : -19.0, kStoreyM * i}}, presence, builder);
        }
    }
}

void add_podium(SceneBuilder& builder) {
    const std::vector<Trade> trades = podium_trades(builder);
    for (int level = 0; level < 2; ++level) {
        for (Trade trade : trades) {
            for (Spot& spot : trade.spots) {  // times are storeys', the place is not turned with the tower
                const double begins = kPodiumStorey + 2.0 * level + trade.begins + trade.takes * spot.order;
                spot.in_storey.position.z += kStoreyM * level;
                add_object(trade.kind, spot.mesh, spot.in_storey, {storey_time(begins)}, builder);
            }
        }
    }
    add_scaffold(builder);
}

void add_trees(SceneBuilder& builder) {
    const uint32_t tree = add_mesh(make_tree(), builder);
    constexpr int kTrees = 260;
    for (int i = 0; i < kTrees; ++i) {  // two rows around the plaza, on its north, east and west
        const int row = i % 2, place = i / 2;
        const double along = (place + 0.5) / (kTrees / 2) * 3.0;  // of three sides
        const int side = static_cast<int>(along);
        const double x = (along - side) * 2.0 - 1.0;
        const Placement in_side{{-x * (52.0 + 8.0 * row), -52.0 - 8.0 * row, 0.0},
                                builder.rng.between(0.0, 6.28)};
        const Placement turned = Placement{{}, (side + 1) * kQuarterRad} * in_side;
        add_object("tree", tree, turned, {3050.0 + 450.0 * (i + 1.0) / kTrees}, builder);
    }
}

}  // namespace data::site
