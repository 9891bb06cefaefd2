// The scheduler: one budget shared by all fronts, refinement interruptible after any operation.
//
//     while time is left
//         too many triangles        -> coarsen where it costs least; while something leaves, which makes way for more that
//                                      is cheap, not where it costs more than the worst error there is
//         worst error > tolerance   -> refine there; near the triangle limit first make room, but only when the
//                                      swap gains more than the hysteresis over all that was given up so far
//         else                      -> release what stays below tolerance * a front's coarsen_ratio, until nothing is left;
//                                      then fronts look again at what they put off, which may give more to do
//
// ROAM's dual-queue loop (Duchaineau 1997) over several hierarchies in one currency, pixels; Funkhouser and
// Sequin (1993) for the idea of a frame budget spent where it buys most.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "lod/front.h"

namespace lod {

/// Asked between operations with the number done so far in this call; true stops the loop. A steady clock, a
/// fake clock or a count: the scheduler itself never reads a clock.
using Deadline = std::function<bool(uint64_t operations)>;

/// Stops after `limit` operations: the deterministic mode.
inline Deadline operation_limit(uint64_t limit) {
    return [limit](uint64_t operations) { return operations >= limit; };
}

/// What a frame may spend and what it should reach.
struct Budget {
    double tolerance_px = 1.0;            ///< >= 0; refine what exceeds it; 0 asks for the source data itself
    uint64_t max_triangles = UINT64_MAX;  ///< over all fronts; what is given up for it may take some frames
    double swap_ratio = 1.5;  ///< > 1: at the triangle limit, swap when refining gains this factor
};

/// Why the loop ended, and what it did.
struct ScheduleResult {
    uint64_t operations = 0;  ///< refine() and coarsen() calls
    bool converged = false;   ///< nothing was left to do; false: the deadline came first
};

/// Adapts the fronts until everything is within the budget, or until the deadline says stop.
/// Never allocates. Cost: the operations' own, plus one query of each front per operation.
ScheduleResult schedule(std::span<Front* const> fronts, const Budget& budget, const Deadline& deadline);

}  // namespace lod
