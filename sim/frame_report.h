// The frame report: what every frame did and cost, as JSON (docs/architecture.md has the contract).
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "lod/front.h"

namespace sim {

/// The three modules whose figures a report tells, in the order of lod::Module.
inline constexpr size_t kModuleCount = 3;
inline constexpr std::array<const char*, kModuleCount> kModuleNames = {"terrain", "objects", "instruments"};

/// One frame. Times are wall-clock milliseconds.
struct FrameRecord {
    int64_t frame = 0;
    double time_s = 0.0;                             ///< simulation time
    double update_ms = 0.0;                          ///< eyepoint, signals, begin_frame
    double refine_ms = 0.0;                          ///< scheduler
    double emit_ms = 0.0;                            ///< draw list
    double submit_ms = 0.0;                          ///< handing over to the driver
    double render_ms = 0.0;                          ///< until the picture is complete
    double total_ms = 0.0;                           ///< from the frame's begin to its complete picture
    bool missed = false;                             ///< total_ms is longer than the period
    std::array<uint64_t, kModuleCount> triangles{};  ///< drawn
    std::array<double, kModuleCount> error_px{};     ///< guaranteed bound inside the view
    double jump_px = 0.0;             ///< farthest a vertex in view moved because the cut changed, a bound
    lod::OperationCounts operations;  ///< of this frame
    uint32_t draw_calls = 0, commands = 0;
    uint64_t front_hash = 0;            ///< of all fronts' cuts
    uint64_t drawn_triangles = 0;       ///< of the adaptive fronts, in view or not; not reported
    uint64_t scheduled_operations = 0;  ///< calls of refine and coarsen; not reported
    bool converged = false;             ///< nothing was left to do; not reported
};

/// What the run was.
struct RunFacts {
    std::string scene;
    double rate_hz = 60.0;
    int width_px = 0, height_px = 0;
    std::string renderer;
    double rss_mb = 0.0;  ///< resident memory at the end
};

/// Distribution of the frames' total times.
struct Summary {
    double p50_ms = 0.0, p95_ms = 0.0, p99_ms = 0.0, max_ms = 0.0;  ///< nearest rank; 0 without frames
    uint64_t missed = 0;
};
Summary summarise(std::span<const FrameRecord> frames);

nlohmann::json to_json(const FrameRecord& frame);
nlohmann::json to_json(const RunFacts& facts, std::span<const FrameRecord> frames);

/// {"terrain": ..., "objects": ..., "instruments": ...}
template <typename Value>
nlohmann::json by_module(const std::array<Value, kModuleCount>& values) {
    nlohmann::json json;
    for (size_t i = 0; i < kModuleCount; ++i)
        json[kModuleNames[i]] = values[i];
    return json;
}

/// Resident memory of this process in MB (10^6 bytes); 0 where the system does not tell.
double resident_mb();

}  // namespace sim
