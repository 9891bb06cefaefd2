#include "lod/scheduler.h"

#include <limits>

namespace lod {
namespace {

struct Choice {
    Front* front = nullptr;
    double error_px = 0.0;
};

Choice worst(std::span<Front* const> fronts) {
    Choice best;
    for (Front* front : fronts) {
        const double error = front->refine_error_px();
        if (error > best.error_px) best = {front, error};
    }
    return best;
}

Choice cheapest(std::span<Front* const> fronts) {
    Choice best{nullptr, std::numeric_limits<double>::infinity()};
    for (Front* front : fronts) {
        const double error = front->coarsen_error_px();
        if (error < best.error_px) best = {front, error};
    }
    return best;
}

uint64_t total_triangles(std::span<Front* const> fronts) {
    uint64_t total = 0;
    for (const Front* front : fronts)
        total += front->triangles();
    return total;
}

/// One operation; false when there is nothing to do.
bool step(std::span<Front* const> fronts, const Budget& budget) {
    const uint64_t triangles = total_triangles(fronts);
    const double release_px = budget.tolerance_px * budget.coarsen_ratio;
    const Choice low = cheapest(fronts);
    if (triangles > budget.max_triangles && low.front) {
        // Only what refining would not want back at once: at least the cheapest, at most a little more.
        return low.front->coarsen(low.error_px).steps > 0;
    }
    if (low.front && low.error_px < release_px) {
        if (low.front->coarsen(release_px).steps > 0) return true;
    }
    const Choice high = worst(fronts);
    if (!high.front || high.error_px <= budget.tolerance_px) return false;
    if (triangles < budget.max_triangles) return high.front->refine().steps > 0;
    if (low.front && high.error_px > low.error_px * budget.swap_ratio) {
        return low.front->coarsen(low.error_px).steps > 0;  // makes room; the next operation refines
    }
    return false;
}

}  // namespace

ScheduleResult schedule(std::span<Front* const> fronts, const Budget& budget, const Deadline& deadline) {
    ScheduleResult result;
    while (!deadline(result.operations)) {
        if (!step(fronts, budget)) {
            result.converged = true;
            break;
        }
        ++result.operations;
    }
    return result;
}

}  // namespace lod
