// BudgetController: how many triangles the next frame may have so that it ends in time.
//
//     predicted ms = fixed + per_triangle * triangles
//     wanted ms    = frame_ms, or less where one frame in twenty takes more than noise_room times what is usual
//
// Every frame says how much longer than predicted it took. The middle one of the last few moves both figures: no single
// frame does, however slow. How far frames lie beyond that middle, over some seconds, is the machine's noise: no budget
// can follow it, so it is left room for, and the limit follows small changes slowly unless frame after frame is over. A
// frame beyond three times what is usual is a stall and teaches nothing; a second in a row is a new load and is believed
// at once. No clock and no hidden state: the plant in the tests is a formula.
#pragma once

#include <array>
#include <cstdint>

namespace sim {

/// What the controller steers towards.
struct BudgetTarget {
    double frame_ms = 12.0;    ///< the part of the period that triangles may fill, > 0
    double noise_room = 1.12;  ///< > 0; a frame that takes so many times frame_ms is still in time
    uint64_t min_triangles = 5000;
    uint64_t max_triangles = 300000;  ///< what the geometry pool holds
};

struct BudgetController {
    BudgetTarget target;
    double fixed_ms = 2.0;  ///< cost of a frame without triangles; a guess, scaled by what is measured
    double per_triangle_ms = 1.5e-4;   ///< likewise
    uint64_t triangles = 30000;        ///< the limit for the next frame
    std::array<double, 9> ratios{};    ///< measured over predicted by the present figures, of the last frames
    std::array<double, 128> excess{};  ///< ratio over what was usual then, likewise
    uint64_t seen = 0;                 ///< frames put into both, ever
    bool was_outlier = false;          ///< the last frame was ignored
};

/// Learns from a finished frame and sets the limit of the next one.
/// @param drawn_triangles  of the cut that was drawn, with those that were only gliding away
/// @param measured_ms      the frame's time without refinement, >= 0
/// Cost: a microsecond.
void observe(BudgetController& controller, uint64_t drawn_triangles, double measured_ms);

}  // namespace sim
