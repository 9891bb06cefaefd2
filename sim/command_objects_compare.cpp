#include "sim/command_objects_compare.h"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "data/scenes/construction_site.h"
#include "objects/clustering/cluster_build.h"
#include "sim/cluster_file.h"
#include "sim/objects_compare/table_two.h"
#include "sim/progress.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

constexpr uint64_t kPaperSeed = 0;

/// Ratios of the source's table 2.
double published_ratio(const TableTwoRow& row) {
    static const std::map<std::string, std::array<double, 3>> kRatios = {{"start", {4.4, 4.7, 5.1}},
                                                                         {"third", {2.0, 2.0, 2.3}},
                                                                         {"two_thirds", {6.4, 6.9, 7.2}},
                                                                         {"end", {16.5, 17.2, 18.9}},
                                                                         {"animation", {4.9, 5.6, 6.0}}};
    return kRatios.at(row.time)[row.screen == 1.0 ? 0 : row.screen == 0.25 ? 1 : 2];
}

lod::Result<objects::ClusterTree> tree_of(const ObjectsCompareArguments& arguments) {
    if (!arguments.is_paper_scene) return read_cluster_file(arguments.source);
    const Stopwatch watch;
    objects::BuildOptions options;
    options.threads = arguments.threads;
    objects::ClusterTree tree =
        objects::build_cluster_tree(data::generate_construction_site(kPaperSeed), options);
    say_progress(fmt::format("construction site: {} objects, {} clusters, built in {:.1f} s",
                             tree.object_count, tree.clusters.size(), watch.seconds()));
    return tree;
}

nlohmann::json to_json(const TableTwoRow& row) {
    return {{"time", row.time},
            {"screen", row.screen},
            {"without_ms", row.without_ms},
            {"with_ms", row.with_ms},
            {"ratio", row.ratio()},
            {"triangles_without", row.triangles_without},
            {"triangles_with", row.triangles_with},
            {"commands_without", row.commands_without},
            {"commands_with", row.commands_with},
            {"error_px", row.error_px}};
}

std::string table_of(const std::vector<TableTwoRow>& rows) {
    std::string text =
        "| moment | screen | without ms | with ms | ratio | published | triangles without / with | commands "
        "without / with | error px |\n|---|---|---|---|---|---|---|---|---|\n";
    for (const TableTwoRow& row : rows) {
        text += fmt::format(
            "| {} | 1/{:.0f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {} / {} | {} / {} | {:.2f} |\n", row.time,
            1.0 / row.screen, row.without_ms, row.with_ms, row.ratio(), published_ratio(row),
            row.triangles_without, row.triangles_with, row.commands_without, row.commands_with, row.error_px);
    }
    return text;
}

}  // namespace

void add_objects_compare(CLI::App& app, ObjectsCompareArguments& arguments) {
    CLI::App& scene = *app.add_option_group("scene")->require_option(1);
    scene.add_option("clusters", arguments.source, "a cluster file (objects build)")->type_name("F.hdlod");
    scene.add_flag("--paper-scene", arguments.is_paper_scene,
                   "instead: the generated construction site of 56,157 objects");
    app.add_option("--tolerance", arguments.tolerance_px, "screen error to reach with levels of detail, px")
        ->check(CLI::Range(0.0, 1e6))
        ->type_name("PX")
        ->capture_default_str();
    app.add_option("--frames", arguments.still_frames, "of each moment; the median counts")
        ->check(CLI::Range(1, 100000))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--animation-frames", arguments.animation_frames,
                   "from the schedule's begin to its end; the mean counts")
        ->check(CLI::Range(2, 100000))
        ->type_name("N")
        ->capture_default_str();
    add_size(app, arguments.size);
    add_threads(app, arguments.threads);
    app.add_option("--report", arguments.report, "write the figures, JSON")->type_name("F.json");
}

lod::Result<lod::Ok> run_objects_compare(const ObjectsCompareArguments& arguments) {
    if (!arguments.report.empty()) {
        if (auto writable = check_writable(arguments.report); !writable) return writable.error();
    }
    auto tree = tree_of(arguments);
    if (!tree) return tree.error();
    TableTwoOptions options;
    options.width_px = arguments.size.width_px;
    options.height_px = arguments.size.height_px;
    options.tolerance_px = arguments.tolerance_px;
    options.still_frames = arguments.still_frames;
    options.animation_frames = arguments.animation_frames;
    const auto rows = measure_table_two(std::move(*tree), options, say_progress);
    if (!rows) return rows.error();
    std::printf("%s", table_of(*rows).c_str());
    if (arguments.report.empty()) return lod::Ok{};
    nlohmann::json json = {{"rows", nlohmann::json::array()}};
    for (const TableTwoRow& row : *rows)
        json["rows"].push_back(to_json(row));
    return write_whole(arguments.report, json.dump(1) + "\n");
}

}  // namespace sim
