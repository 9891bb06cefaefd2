// BudgetController: how many triangles the next frame may have so that it ends in time.
//
//     predicted ms = fixed + per_triangle * triangles
//
// Each frame's measured time scales both figures: quickly when the frame was too long, slowly when it was short.
// A single frame beyond three times what is usual is a stall of the machine and teaches nothing; a second in a
// row is a new load and is believed at once. No clock and no hidden state: the plant in the tests is a formula.
#pragma once

#include <array>
#include <cstdint>

namespace sim {

/// What the controller steers towards.
struct BudgetTarget {
    double frame_ms = 12.0;  ///< the part of the period that triangles may fill, > 0
    uint64_t min_triangles = 5000;
    uint64_t max_triangles = 300000;  ///< what the geometry pool holds
};

struct BudgetController {
    BudgetTarget target;
    double fixed_ms = 2.0;  ///< cost of a frame without triangles; a guess, scaled by what is measured
    double per_triangle_ms = 1.5e-4;  ///< likewise
    uint64_t triangles = 30000;       ///< the limit for the next frame
    std::array<double, 9> ratios{};   ///< measured over predicted, of the last frames
    uint32_t seen = 0;                ///< frames put into `ratios`, ever
    bool was_outlier = false;         ///< the last frame was ignored
};

/// Learns from a finished frame and sets the limit of the next one.
/// @param drawn_triangles  of the cut that was drawn
/// @param measured_ms      the frame's time without refinement, >= 0
void observe(BudgetController& controller, uint64_t drawn_triangles, double measured_ms);

}  // namespace sim
