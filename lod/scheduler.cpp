#include "lod/scheduler.h"

#include <algorithm>
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

/// Triangles that one refinement may bring at the most, forced ones included, on any hierarchy of ours.
constexpr uint64_t kLargestRefinement = 64;

bool is_leaving(std::span<Front* const> fronts) {
    return std::any_of(fronts.begin(), fronts.end(),
                       [](const Front* front) { return front->leaving_triangles() > 0; });
}

/// While something leaves, which makes way for more that is as cheap, nothing beyond this times the worst error is given up.
constexpr double kPatience = 1.1;

/// One call's bargain: what has been given up for room sets what a further refinement must at least gain.
class Bargain {
  public:
    Bargain(std::span<Front* const> fronts, const Budget& budget)
        : fronts_(fronts),
          budget_(budget),
          patience_px_(kPatience * std::max(worst(fronts).error_px, budget.tolerance_px)) {}

    /// One operation; false when there is nothing worth doing.
    bool step() {
        const uint64_t triangles = total_triangles(fronts_);
        const bool is_over = triangles > budget_.max_triangles;
        const Choice high = is_over ? Choice{} : worst(fronts_);
        const bool is_needed = high.front && high.error_px > budget_.tolerance_px;
        // The usual step first: nobody need say what could go while there is room.
        if (is_needed && triangles + kLargestRefinement <= budget_.max_triangles) return refine(high);
        const Choice low = cheapest(fronts_);
        if (is_over && low.front && !is_worth_waiting(low)) return give_up(low);
        if (is_needed) {
            const bool is_worth_it = !low.front || high.error_px > low.error_px * budget_.swap_ratio;
            if (is_worth_it && triangles < budget_.max_triangles) return refine(high);
            if (is_worth_it && low.front && is_gain(high)) return give_up(low);
        }
        return release();
    }

  private:
    /// Takes back what its front does not need for the tolerance, where it is needed least.
    bool release() {
        Choice least{nullptr, budget_.tolerance_px};
        for (Front* front : fronts_) {
            const double error_px = front->coarsen_error_px() / front->coarsen_ratio();
            if (error_px < least.error_px) least = {front, error_px};
        }
        return least.front &&
               least.front->coarsen(budget_.tolerance_px * least.front->coarsen_ratio()).steps > 0;
    }
    bool is_worth_waiting(const Choice& low) const {
        return low.error_px > patience_px_ && is_leaving(fronts_);
    }
    bool is_gain(const Choice& high) const { return high.error_px > paid_px_ * budget_.swap_ratio; }
    bool refine(const Choice& high) { return is_gain(high) && high.front->refine().steps > 0; }
    bool give_up(const Choice& low) {
        paid_px_ = std::max(paid_px_, low.error_px);
        return low.front->coarsen(low.error_px).steps > 0;
    }

    std::span<Front* const> fronts_;
    const Budget& budget_;
    double patience_px_ = 0.0;
    double paid_px_ = 0.0;
};

bool settle_all(std::span<Front* const> fronts) {
    bool has_changed = false;
    for (Front* front : fronts)
        has_changed = front->settle() || has_changed;
    return has_changed;
}

}  // namespace

ScheduleResult schedule(std::span<Front* const> fronts, const Budget& budget, const Deadline& deadline) {
    ScheduleResult result;
    Bargain bargain(fronts, budget);
    while (!deadline(result.operations)) {
        if (bargain.step()) {
            ++result.operations;
        } else if (!settle_all(fronts)) {
            result.converged = true;
            break;
        }
    }
    return result;
}

}  // namespace lod
