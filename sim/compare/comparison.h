// comparison: every method on one grid at equal measured errors, and the requirements they meet.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/compare/inspection.h"
#include "sim/compare/race.h"
#include "sim/compare/requirements.h"

namespace sim {

/// One method at one error.
struct CompareRow {
    std::string method;
    double target_px = 0.0;
    Calibration calibration;
    Inspection inspection;
    RaceTimes times;
    double memory_mb = 0.0;  ///< tables, errors, sequences, queues; without heights and geometry pool
    double pool_mb = 0.0;    ///< of the geometry pool, as needed at the flight's end
    double prepare_s = 0.0;
};

/// One method's figures, in the order of kRequirements; none: not measured.
struct RequirementRow {
    std::string method;
    std::array<std::optional<double>, kRequirements.size()> figures;
};

struct Comparison {
    int width = 0, height = 0;  ///< samples
    double cell_m = 0.0;
    std::vector<CompareRow> rows;  ///< by target, then by method
    std::vector<LeftOut> left_out;
    std::vector<RequirementRow> requirements;
};

struct CompareOptions {
    SortieOptions sorties;
    MethodOptions methods;
    std::vector<double> targets_px = {0.5, 1.0, 2.0, 4.0};
};

/// Prepares all methods, then for each error: searches tolerances, inspects, races. The requirements are measured at
/// the error nearest to 1 px. Fails when there is no OpenGL.
lod::Result<Comparison> compare_methods(const data::HeightGrid& grid, const CompareOptions& options);

}  // namespace sim
