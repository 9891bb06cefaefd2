// requirements: the paper's list of what a terrain method should do, each as a figure with a limit.
// Source: Elykov, Lavrentiev et al. (Softlab-NSK), section 2; the limits are Harrier's.
#pragma once

#include <array>
#include <string_view>

#include "sim/compare/method.h"

namespace sim {

/// One requirement: a figure that must not exceed a limit.
struct Requirement {
    std::string_view name;    ///< snake_case, for JSON
    std::string_view figure;  ///< what is measured
    double limit;             ///< yes: at most this
};

inline constexpr std::array<Requirement, 8> kRequirements = {{
    {"minimal_redundancy", "triangles at 1 px / ROAM's", 1.1},
    {"no_gaps_geometry", "T-junctions in a picture", 0.0},
    {"no_gaps_lighting", "ground colour beside its place, cells", 0.01},
    {"local_features", "new triangles when one sample becomes a spike", 500.0},
    {"stable_frame_time", "frame time p99 / p50, coherent flight", 1.5},
    {"long_strips", "vertices fetched a triangle, 16 kept", 1.0},
    {"small_moves", "share of the mesh changed a frame", 0.05},
    {"complexity_control", "triangles beside half of them asked for, share", 0.01},
}};

inline bool is_met(const Requirement& requirement, double figure) {
    return figure <= requirement.limit;
}

/// Figures of one method that need a picture of their own.
struct PictureFigures {
    double t_junctions = 0.0;
    double colour_beside_cells = 0.0;
    double off_limit_share =
        0.0;  ///< |triangles - limit| / limit, the limit half of what the tolerance takes
};

/// Measures one picture at a tolerance. The front is begun anew.
PictureFigures measure_picture(Method& method, const data::HeightGrid& grid, const lod::View& view,
                               double tolerance_px);

/// How many triangles of a picture were not there before one sample was raised by 16 cells: a square of up to
/// 257 samples around the raster's middle, seen from above one corner at a tolerance of 1 px; -1: no such method.
double measure_spike(const std::string& method_name, const data::HeightGrid& grid,
                     const MethodOptions& options);

}  // namespace sim
