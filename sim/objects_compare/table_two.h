// TableTwo: frame times of a timed scene with and without hierarchical dynamic levels of detail, at the moments and
// sizes of the source's table 2; both in one run, in turns, by one renderer.
//
// Source: Semenov, Shutkin, Zolotov et al., Visualization of large scenes with deterministic dynamics (2020), section 5.
// Differs from it in: what is drawn with levels of detail is within a stated bound in pixels.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "objects/cluster_tree.h"

namespace sim {

struct TableTwoOptions {
    int width_px = 1280, height_px = 720;
    double tolerance_px = 2.0;
    int still_frames = 9;       ///< of each moment, the median counts
    int animation_frames = 48;  ///< evenly over [0, T], the mean counts
};

struct TableTwoRow {
    std::string time;     ///< start, third, two_thirds, end or animation
    double screen = 1.0;  ///< share of the picture the scene fills: 1, 1/4, 1/16
    double without_ms = 0.0, with_ms = 0.0;
    uint64_t triangles_without = 0, triangles_with = 0;  ///< of the last frame; animation: the mean
    uint64_t commands_without = 0, commands_with = 0;    ///< the same
    double error_px = 0.0;                               ///< largest bound told with levels of detail

    double ratio() const { return without_ms / with_ms; }
};

/// @param progress  told before each row what it will be
/// Fails where no renderer can be had.
lod::Result<std::vector<TableTwoRow>> measure_table_two(
    objects::ClusterTree tree, const TableTwoOptions& options,
    const std::function<void(const std::string&)>& progress);

}  // namespace sim
