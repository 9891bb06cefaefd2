#include "data/scenes/site_tower.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "data/scenes/site_meshes.h"
#include "data/scenes/site_plan.h"
#include "data/scenes/trade.h"

namespace data::site {

namespace {

constexpr double kQuarterRad = std::numbers::pi / 2.0;

using Spots = std::vector<Spot>;

Spots ordered(Spots spots) {
    order_along_curve(spots);
    return spots;
}

bool is_core(int col, int row) {
    return std::abs(col) <= 1 && std::abs(row) <= 1;
}

/// The middles of all bays but those of the core.
Spots bays(uint32_t mesh, double z_m = 0.0) {
    Spots spots;
    for (int row = -kHalfBays; row < kHalfBays; ++row) {
        for (int col = -kHalfBays; col < kHalfBays; ++col) {
            if (col >= -1 && col <= 0 && row >= -1 && row <= 0) continue;
            spots.push_back({{{kBayM * (col + 0.5), kBayM * (row + 0.5), z_m}}, mesh});
        }
    }
    return ordered(spots);
}

/// Columns on the grid's nodes outside the core; those a quarter turn apart share a mesh.
Spots columns(SceneBuilder& builder) {
    Spots spots;
    for (int col = 2; col <= kHalfBays; ++col) {
        for (int row = 1 - col; row <= col; ++row) {
            const Placement node{{kBayM * col, kBayM * row, 0.0}};
            const glm::dvec3 lean = (Placement{{}, kTwistRad} * node).position - node.position;
            const uint32_t mesh = add_mesh(make_column({lean.x, lean.y}), builder);
            for (int quarter = 0; quarter < 4; ++quarter)
                spots.push_back({Placement{{}, quarter * kQuarterRad} * node, mesh});
        }
    }
    return ordered(spots);
}

/// The middles of the grid's edges, along x and along y: those between two nodes of the core, or all others.
Spots edges(uint32_t mesh, bool of_core) {
    Spots spots;
    for (int row = -kHalfBays; row <= kHalfBays; ++row) {
        for (int col = -kHalfBays; col < kHalfBays; ++col) {
            const bool is_inner = is_core(col, row) && is_core(col + 1, row);
            if (is_inner != of_core || (is_inner && row == 0))
                continue;  // no wall through the middle of the core
            const Placement along_x{{kBayM * (col + 0.5), kBayM * row, 0.0}};
            spots.push_back({along_x, mesh});
            spots.push_back({Placement{{}, kQuarterRad} * along_x, mesh});
        }
    }
    return ordered(spots);
}

/// `per_side` objects along each side of the tower, `inset_m` inside its edge; [mesh] in turn.
Spots around(const std::vector<uint32_t>& meshes, int per_side, double inset_m, SceneBuilder& builder) {
    Spots spots;
    for (int side = 0; side < 4; ++side) {
        for (int i = 0; i < per_side; ++i) {
            const double x = kHalfTowerM * (2.0 * (i + 0.5) / per_side - 1.0);
            const uint32_t mesh = meshes[builder.rng.below(meshes.size())];
            spots.push_back(
                {Placement{{}, side * kQuarterRad} * Placement{{x, inset_m - kHalfTowerM, 0.0}}, mesh});
        }
    }
    return ordered(spots);
}

/// `count` objects in the bays, `apart_m` from one another within a bay, turned by quarters at random.
Spots inside(uint32_t mesh, int count, double apart_m, SceneBuilder& builder) {
    const Spots middles = bays(mesh);
    Spots spots;
    for (int i = 0; i < count; ++i) {
        const Placement& bay = middles[static_cast<size_t>(i) % middles.size()].in_storey;
        const double turn_rad = static_cast<double>(builder.rng.below(4)) * kQuarterRad;
        const double x = (i / static_cast<int>(middles.size()) % 2 == 0 ? -1 : 1) * apart_m;
        spots.push_back({bay * Placement{{x, builder.rng.between(-1.0, 1.0), 0.0}, turn_rad}, mesh});
    }
    return ordered(spots);
}

Spots stairs_and_lifts(uint32_t stairs, uint32_t door) {
    Spots spots;
    for (const double x : {-5.0, 5.0})
        spots.push_back({{{x, 0.0, 0.0}}, stairs});
    for (const double x : {-2.4, -0.8, 0.8, 2.4})
        spots.push_back({{{x, -2.0, 0.0}}, door});
    return ordered(spots);
}

std::vector<uint32_t> facade_meshes(SceneBuilder& builder) {
    return {add_mesh(make_facade({62, 98, 128}), builder), add_mesh(make_facade({72, 110, 138}), builder),
            add_mesh(make_facade({54, 88, 120}), builder)};
}

/// The work of one storey: 534 objects with 37,264 triangles.
std::vector<Trade> storey_trades(SceneBuilder& builder) {
    const uint32_t railing = add_mesh(make_railing(), builder);
    return {
        // kind, spots, begins, takes, stays
        {"formwork", bays(add_mesh(make_formwork(), builder)), 0.0, 0.5, 2.0},
        {"rebar", bays(add_mesh(make_rebar(), builder)), 0.3, 0.4, 0.4},
        {"slab", bays(add_mesh(make_slab(), builder)), 0.7, 0.4, 0.0},
        {"beam", edges(add_mesh(make_beam(), builder), false), 0.2, 0.5, 0.0},
        {"corewall", edges(add_mesh(make_core_wall(), builder), true), 0.6, 0.5, 0.0},
        {"column", columns(builder), 0.9, 0.5, 0.0},
        {"railing", around({railing}, 6, 0.3, builder), 1.0, 0.3, 7.5},
        {"prop", bays(add_mesh(make_prop(), builder)), 2.0, 0.5, 4.0},
        {"stairs", stairs_and_lifts(add_mesh(make_stairs(), builder), add_mesh(make_lift_door(), builder)),
         3.0, 2.0, 0.0},
        {"facade", around(facade_meshes(builder), 28, 0.0, builder), 8.0, 1.6, 0.0},
        {"duct", inside(add_mesh(make_duct(), builder), 40, 1.6, builder), 10.0, 2.0, 0.0},
        {"partition", inside(add_mesh(make_partition(), builder), 48, 2.0, builder), 12.0, 2.0, 0.0},
        {"desk", inside(add_mesh(make_desk(), builder), 56, 1.5, builder), 16.0, 3.0, 0.0},
    };
}

bool is_structure(const Trade& trade) {
    return trade.kind == "slab" || trade.kind == "beam" || trade.kind == "corewall" || trade.kind == "column";
}

/// The roof's beams and slabs, a screen of facade panels around it and a spire.
void add_crown(const std::vector<Trade>& trades, SceneBuilder& builder) {
    for (const Trade& trade : trades) {
        if (trade.kind == "slab" || trade.kind == "beam") add_trade(trade, kStoreys, builder);
    }
    const Trade screen{"screen", around(facade_meshes(builder), 28, 0.0, builder), 3.0, 2.0, 0.0};
    add_trade(screen, kStoreys, builder);
    add_trade(screen, kStoreys + 1, builder);
    const uint32_t spire = add_mesh(make_mast(), builder);
    for (int i = 0; i < 8; ++i) {
        const Placement place{{0.0, 0.0, kStoreys * kStoreyM + 6.0 * i}, i * 0.1};
        add_object("spire", spire, place, {storey_time(kStoreys + 4.0 + 0.5 * i)}, builder);
    }
}

}  // namespace

void add_tower(SceneBuilder& builder) {
    const std::vector<Trade> trades = storey_trades(builder);
    for (int storey = -kCellars; storey < 0; ++storey) {
        for (const Trade& trade : trades) {
            if (is_structure(trade)) add_trade(trade, storey, builder);
        }
    }
    for (int storey = 0; storey < kStoreys; ++storey) {
        for (const Trade& trade : trades)
            add_trade(trade, storey, builder);
    }
    add_crown(trades, builder);
}

}  // namespace data::site
