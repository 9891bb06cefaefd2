#include "sim/budget_controller.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sim {
namespace {

constexpr double kOutlier = 3.0;
constexpr double kGain = 0.15;
// A limit that differs by less is followed by a share a frame, as every change sets vertices gliding; not when all of
// the last few frames took so much longer than predicted.
constexpr double kNear = 0.25, kNearGain = 0.06, kOver = 1.1;
constexpr uint64_t kFew = 3;
constexpr double kGrowth = 1.2;      // no frame may have more than this times the triangles of the one before
constexpr double kSlowShare = 0.95;  // so many frames are faster than what noise is measured by
constexpr uint64_t kFewest = 32;     // frames that say something about noise
constexpr double kMostNoise = 1.4;   // no room for more: stalls are no noise, and room costs detail

/// @param share  in [0, 1): 0.5 for the median  @param seen  of all that were ever put into the ring, at least 1
template <size_t kSize>
double quantile(std::array<double, kSize> ring, uint64_t seen, double share) {
    const std::span values = std::span(ring).first(static_cast<size_t>(std::min<uint64_t>(seen, kSize)));
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

double usual(const BudgetController& controller) {
    return controller.seen == 0 ? 1.0 : quantile(controller.ratios, controller.seen, 0.5);
}

/// How many times what is usual one frame in twenty takes or more, as far as there is room for it.
double noise(const BudgetController& controller) {
    if (controller.seen < kFewest) return 1.0;
    return std::min(quantile(controller.excess, controller.seen, kSlowShare), kMostNoise);
}

void remember(BudgetController& controller, double ratio) {
    controller.ratios[controller.seen % controller.ratios.size()] = ratio;
    ++controller.seen;
    controller.excess[(controller.seen - 1) % controller.excess.size()] = ratio / usual(controller);
}

void scale_model(BudgetController& controller, double factor) {
    controller.fixed_ms *= factor;
    controller.per_triangle_ms *= factor;
}

/// Moves towards what is usual now.
void follow(BudgetController& controller) {
    const double factor = 1.0 + kGain * (usual(controller) - 1.0);
    scale_model(controller, factor);
    for (double& ratio : controller.ratios)
        ratio /= factor;  // past frames, seen with the new figures
}

/// The frame tells what is usual from now on; those before are forgotten.
void believe(BudgetController& controller, double ratio) {
    scale_model(controller, ratio);
    controller.ratios.fill(1.0);
}

bool are_last_over(const BudgetController& controller) {
    for (uint64_t back = 1; back <= kFew; ++back) {
        if (controller.ratios[(controller.seen - back) % controller.ratios.size()] <= kOver) return false;
    }
    return true;
}

/// The next limit, on the way to the one that is wanted.
double approach(const BudgetController& controller, double wanted) {
    const auto present = static_cast<double>(controller.triangles);
    const bool is_near = std::abs(wanted - present) < kNear * present;
    if (is_near && !are_last_over(controller)) return present + kNearGain * (wanted - present);
    return std::min(wanted, kGrowth * present);
}

}  // namespace

void observe(BudgetController& controller, uint64_t drawn_triangles, double measured_ms) {
    const double predicted_ms =
        controller.fixed_ms + controller.per_triangle_ms * static_cast<double>(drawn_triangles);
    const double ratio = std::max(measured_ms, 1e-3) / predicted_ms;
    const bool is_calibrated = controller.seen >= kFew;
    const bool is_outlier = is_calibrated && ratio > kOutlier * usual(controller);
    const bool is_stall = is_outlier && !controller.was_outlier;
    controller.was_outlier = is_stall;
    remember(controller, ratio);
    if (is_stall) return;
    if (is_outlier || !is_calibrated)
        believe(controller, ratio);
    else
        follow(controller);

    const BudgetTarget& target = controller.target;
    const double wanted_ms = target.frame_ms * std::min(1.0, target.noise_room / noise(controller));
    const double wanted = std::max(wanted_ms - controller.fixed_ms, 0.0) / controller.per_triangle_ms;
    controller.triangles = static_cast<uint64_t>(std::clamp(approach(controller, wanted),
                                                            static_cast<double>(target.min_triangles),
                                                            static_cast<double>(target.max_triangles)));
}

}  // namespace sim
