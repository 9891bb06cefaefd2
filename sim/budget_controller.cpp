#include "sim/budget_controller.h"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

constexpr double kOutlier = 3.0;
constexpr double kGainShort = 0.15, kGainNear = 0.3, kGainLong = 0.7;
constexpr double kGrowth = 1.2;  // no frame may have more than this times the triangles of the one before

double median(const BudgetController& controller) {
    const size_t count = std::min<size_t>(controller.seen, controller.ratios.size());
    if (count == 0) return 1.0;
    std::array<double, 9> sorted = controller.ratios;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
}

void scale_model(BudgetController& controller, double factor) {
    controller.fixed_ms *= factor;
    controller.per_triangle_ms *= factor;
    for (double& ratio : controller.ratios)
        ratio /= factor;  // past frames, seen with the new figures
}

}  // namespace

void observe(BudgetController& controller, uint64_t drawn_triangles, double measured_ms) {
    const double predicted_ms =
        controller.fixed_ms + controller.per_triangle_ms * static_cast<double>(drawn_triangles);
    const double ratio = std::max(measured_ms, 1e-3) / predicted_ms;
    const bool is_calibrated = controller.seen >= 3;
    const bool is_outlier = is_calibrated && ratio > kOutlier * median(controller);
    if (is_outlier && !controller.was_outlier) {
        controller.was_outlier = true;
        return;
    }
    const bool is_new_load = !is_calibrated || is_outlier;
    controller.was_outlier = false;
    controller.ratios[controller.seen % controller.ratios.size()] = ratio;
    ++controller.seen;
    const double gain = is_new_load                                ? 1.0
                        : measured_ms > controller.target.frame_ms ? kGainLong
                        : ratio > 0.9                              ? kGainNear
                                                                   : kGainShort;
    scale_model(controller, 1.0 + gain * (ratio - 1.0));

    const double room_ms = controller.target.frame_ms - controller.fixed_ms;
    const double wanted = std::max(room_ms, 0.0) / controller.per_triangle_ms;
    const double limit = std::min(wanted, kGrowth * static_cast<double>(controller.triangles));
    controller.triangles =
        static_cast<uint64_t>(std::clamp(limit, static_cast<double>(controller.target.min_triangles),
                                         static_cast<double>(controller.target.max_triangles)));
}

}  // namespace sim
