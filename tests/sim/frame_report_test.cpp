// The report's JSON against the contract of docs/architecture.md: names, nesting, nothing more and nothing less.
#include "sim/frame_report.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using nlohmann::json;

std::set<std::string> keys(const json& object) {
    std::set<std::string> names;
    for (const auto& [key, value] : object.items())
        names.insert(key);
    return names;
}

sim::FrameRecord make_record(int64_t frame, double total_ms) {
    sim::FrameRecord record;
    record.frame = frame;
    record.total_ms = total_ms;
    record.missed = total_ms > 16.0;
    return record;
}

TEST(FrameReport, HasExactlyTheContractsFields) {
    sim::FrameRecord record = make_record(3, 17.0);
    record.operations[lod::OperationKind::kForcedSplit] = 5;
    record.operations[lod::OperationKind::kEcol] = 7;
    record.triangles = {10, 20, 30};
    record.error_px = {0.5, 0.25, 0.0};
    record.jump_px = 0.375;
    record.front_hash = 0x0123456789abcdefu;
    const sim::RunFacts facts{"a.toml", 60.0, 640, 360, "llvmpipe", 123.0};
    const std::string text = sim::to_json(facts, std::vector{record}).dump();
    const json report = json::parse(text);

    EXPECT_EQ(keys(report),
              (std::set<std::string>{"scene", "rate_hz", "size", "renderer", "frames", "summary"}));
    EXPECT_EQ(report["size"], json::array({640, 360}));
    const json& frame = report["frames"].at(0);
    EXPECT_EQ(keys(frame), (std::set<std::string>{"frame", "time_s", "cpu_ms", "render_ms", "total_ms",
                                                  "missed", "triangles", "error_px", "jump_px", "operations",
                                                  "draw_calls", "commands", "front_hash"}));
    EXPECT_EQ(frame["jump_px"], 0.375);
    EXPECT_EQ(keys(frame["cpu_ms"]), (std::set<std::string>{"update", "refine", "emit", "submit"}));
    EXPECT_EQ(keys(frame["triangles"]), (std::set<std::string>{"terrain", "objects", "instruments"}));
    EXPECT_EQ(keys(frame["error_px"]), keys(frame["triangles"]));
    EXPECT_EQ(keys(frame["operations"]),
              (std::set<std::string>{"split", "forced_split", "merge", "enh_merge", "cluster_refine",
                                     "cluster_coarsen", "vsplit", "ecol"}));
    EXPECT_EQ(keys(report["summary"]),
              (std::set<std::string>{"p50_ms", "p95_ms", "p99_ms", "max_ms", "missed", "rss_mb"}));
    EXPECT_EQ(frame["operations"]["forced_split"], 5);
    EXPECT_EQ(frame["operations"]["ecol"], 7);
    EXPECT_EQ(frame["triangles"]["objects"], 20);
    EXPECT_EQ(frame["missed"], true);
    EXPECT_EQ(frame["front_hash"], "0123456789abcdef");
}

TEST(FrameReport, PercentilesAreNearestRanks) {
    std::vector<sim::FrameRecord> frames;
    for (int i = 100; i >= 1; --i)
        frames.push_back(make_record(i, i));
    const sim::Summary summary = sim::summarise(frames);
    EXPECT_EQ(summary.p50_ms, 50.0);
    EXPECT_EQ(summary.p95_ms, 95.0);
    EXPECT_EQ(summary.p99_ms, 99.0);
    EXPECT_EQ(summary.max_ms, 100.0);
    EXPECT_EQ(summary.missed, 84u);
    EXPECT_EQ(sim::summarise(std::span(frames).first(10)).p95_ms, 100.0);  // of 91 to 100: the tenth
    EXPECT_EQ(sim::summarise(std::span(frames).first(1)).p50_ms, 100.0);
    EXPECT_EQ(sim::summarise({}).max_ms, 0.0);
}

TEST(FrameReport, KnowsItsMemory) {
    EXPECT_GT(sim::resident_mb(), 1.0);
    EXPECT_LT(sim::resident_mb(), 1e5);
}

}  // namespace
