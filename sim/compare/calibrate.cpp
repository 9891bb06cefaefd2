#include "sim/compare/calibrate.h"

#include <algorithm>
#include <cmath>

#include "sim/compare/surface.h"

namespace sim {
namespace {

constexpr int kMostTrials = 14;
constexpr double kCloseEnough = 0.015;  // relative
constexpr double kNarrowest = 1.002;    // bracket, as a ratio

double miss(const Calibration& trial, double target_px) {
    return std::abs(trial.measured_px / target_px - 1.0);
}

}  // namespace

Calibration try_tolerance(Method& method, const data::HeightGrid& grid, const std::vector<lod::View>& views,
                          double tolerance_px, unsigned threads) {
    Calibration trial{tolerance_px, 0.0, 0};
    for (const lod::View& view : views) {
        restart(method, tolerance_px, 0);
        adapt(method, view, 0.0, tolerance_px);
        const MeasuredError error = measure_error(grid, view, triangles_of(method), threads);
        trial.measured_px = std::max(trial.measured_px, error.max_px);
        trial.triangles = std::max(trial.triangles, method.front->triangles());
    }
    return trial;
}

Calibration calibrate(Method& method, const data::HeightGrid& grid, const std::vector<lod::View>& views,
                      double target_px, unsigned threads) {
    double low_px = 0.5 * target_px, high_px = 64.0 * target_px, next_px = 1.2 * target_px;
    Calibration best;
    for (int i = 0; i < kMostTrials; ++i) {
        const Calibration trial = try_tolerance(method, grid, views, next_px, threads);
        if (best.tolerance_px == 0.0 || miss(trial, target_px) < miss(best, target_px)) best = trial;
        if (miss(best, target_px) <= kCloseEnough) break;
        (trial.measured_px > target_px ? high_px : low_px) = next_px;
        if (high_px / low_px < kNarrowest) break;
        next_px *=
            target_px / std::max(trial.measured_px, 1e-6);  // an error goes about as the tolerance does
        const double middle_px = std::sqrt(low_px * high_px);
        const double margin = std::pow(high_px / low_px, 0.02);
        if (next_px < low_px * margin || next_px > high_px / margin || i % 4 == 3) next_px = middle_px;
    }
    return best;
}

}  // namespace sim
