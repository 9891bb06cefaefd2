// calibrate: the tolerance a method must be given so that the error it is measured to make is the one asked for.
#pragma once

#include "sim/compare/method.h"

namespace sim {

struct Calibration {
    double tolerance_px = 0.0;  ///< what the method is to be asked for
    double measured_px = 0.0;   ///< what it then makes: the largest over all samples in the views
    uint64_t triangles = 0;     ///< of the largest cut in one of the views
};

/// Searches by secants on the logarithms, inside a bracket. Every view begins with the coarsest mesh, so no history
/// helps or hurts a method. The measured error moves in steps; the nearest is taken.
/// @param target_px  > 0
Calibration calibrate(Method& method, const data::HeightGrid& grid, const std::vector<lod::View>& views,
                      double target_px, unsigned threads);

/// The largest error over the views for one tolerance.
Calibration try_tolerance(Method& method, const data::HeightGrid& grid, const std::vector<lod::View>& views,
                          double tolerance_px, unsigned threads);

}  // namespace sim
