// The parts a tower is put together from. Each function makes one mesh; its triangles are counted in the name's comment.
#pragma once

#include "data/scenes/solids.h"

namespace data::site {

TimedMesh make_slab();        ///< one bay of floor with two ribs, top at z = 0: 48
TimedMesh make_core_wall();   ///< one bay of core wall with a door, along x: 36
TimedMesh make_beam();        ///< a steel I with end plates, one bay along x, top at z = -0.3: 60
TimedMesh make_stairs();      ///< one flight over a storey: 240
TimedMesh make_lift_door();   ///< 36
TimedMesh make_partition();   ///< 36
TimedMesh make_duct();        ///< under a ceiling, along x: 64
TimedMesh make_desk();        ///< 72
TimedMesh make_railing();     ///< one bay of temporary railing along x: 72
TimedMesh make_formwork();    ///< a table of formwork under one bay: 108
TimedMesh make_prop();        ///< a steel prop between two floors: 52
TimedMesh make_rebar();       ///< a mat of reinforcement for one bay: 120
TimedMesh make_scaffold();    ///< one bay of scaffolding, two lifts high, along x: 144
TimedMesh make_mast();        ///< 6 m of lattice mast: 192
TimedMesh make_hoist_mast();  ///< 4 m of a hoist's mast: 96
TimedMesh make_tree();        ///< about 9 m high: 340

/// A column that leans so that it meets its successor in the storey above: 52.
/// @param lean  of its upper end, m
TimedMesh make_column(const glm::dvec2& lean);

/// 1.5 m of facade along x, outside towards -y: 84.
TimedMesh make_facade(const Colour& glass);

}  // namespace data::site
