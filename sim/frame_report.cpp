#include "sim/frame_report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace sim {
namespace {

constexpr std::array<const char*, static_cast<size_t>(lod::OperationKind::kCount)> kOperationNames = {
    "split", "forced_split", "merge", "enh_merge", "cluster_refine", "cluster_coarsen", "vsplit", "ecol"};

}  // namespace

Summary summarise(std::span<const FrameRecord> frames) {
    Summary summary;
    if (frames.empty()) return summary;
    std::vector<double> times;
    for (const FrameRecord& frame : frames) {
        times.push_back(frame.total_ms);
        summary.missed += frame.missed;
    }
    std::sort(times.begin(), times.end());
    const auto rank = [&](double share) {
        const double place = std::ceil(share * static_cast<double>(times.size()));
        return times[static_cast<size_t>(std::max(place, 1.0)) - 1];
    };
    summary.p50_ms = rank(0.50);
    summary.p95_ms = rank(0.95);
    summary.p99_ms = rank(0.99);
    summary.max_ms = times.back();
    return summary;
}

nlohmann::json to_json(const FrameRecord& frame) {
    nlohmann::json operations;
    for (size_t i = 0; i < kOperationNames.size(); ++i)
        operations[kOperationNames[i]] = frame.operations.count[i];
    return {{"frame", frame.frame},
            {"time_s", frame.time_s},
            {"cpu_ms",
             {{"update", frame.update_ms},
              {"refine", frame.refine_ms},
              {"emit", frame.emit_ms},
              {"submit", frame.submit_ms}}},
            {"render_ms", frame.render_ms},
            {"total_ms", frame.total_ms},
            {"missed", frame.missed},
            {"triangles", by_module(frame.triangles)},
            {"error_px", by_module(frame.error_px)},
            {"jump_px", frame.jump_px},
            {"operations", operations},
            {"draw_calls", frame.draw_calls},
            {"commands", frame.commands},
            {"front_hash", fmt::format("{:016x}", frame.front_hash)}};
}

nlohmann::json to_json(const RunFacts& facts, std::span<const FrameRecord> frames) {
    nlohmann::json list = nlohmann::json::array();
    for (const FrameRecord& frame : frames)
        list.push_back(to_json(frame));
    const Summary summary = summarise(frames);
    return {{"scene", facts.scene},
            {"rate_hz", facts.rate_hz},
            {"size", {facts.width_px, facts.height_px}},
            {"renderer", facts.renderer},
            {"frames", std::move(list)},
            {"summary",
             {{"p50_ms", summary.p50_ms},
              {"p95_ms", summary.p95_ms},
              {"p99_ms", summary.p99_ms},
              {"max_ms", summary.max_ms},
              {"missed", summary.missed},
              {"rss_mb", facts.rss_mb}}}};
}

double resident_mb() {
    std::ifstream statm("/proc/self/statm");
    double size_pages = 0.0, resident_pages = 0.0;
    if (!(statm >> size_pages >> resident_pages)) return 0.0;
    return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace sim
