#include "sim/command_compare.h"

#include <cstdio>

#include "data/fractal_grid.h"
#include "sim/compare/comparison_report.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

constexpr uint64_t kFractalSeed = 1;
constexpr double kFractalCell_m = 1.0;
constexpr int kLeastSide = 33;  // a block

lod::Result<data::HeightGrid> relief_of(const CompareArguments& arguments) {
    if (arguments.fractal_side > 0) {
        return data::fractal_grid(arguments.fractal_side, arguments.fractal_side, kFractalCell_m,
                                  arguments.fractal_relief_m, kFractalSeed);
    }
    auto grid = data::read_height_grid(arguments.sources, {});
    if (!grid) return grid.error();
    if (grid->width < kLeastSide || grid->height < kLeastSide) {
        return lod::Error{arguments.sources.front() + ": " + std::to_string(grid->width) + " x " +
                          std::to_string(grid->height) + " samples, expected at least 33 x 33 to compare"};
    }
    return grid;
}

}  // namespace

void add_compare(CLI::App& app, CompareArguments& arguments) {
    CLI::App& relief = *app.add_option_group("relief")->require_option(1);
    relief.add_option("dem", arguments.sources, "rasters of heights, joined on the grid of the first")
        ->type_name("DEM...");
    relief
        .add_option("--fractal", arguments.fractal_side,
                    "instead: fractal relief of N x N samples, 1 m apart, seed 1")
        ->check(CLI::Range(kLeastSide, 8193))
        ->type_name("N");
    app.add_option("--relief", arguments.fractal_relief_m, "of the fractal's widest swing, m")
        ->check(CLI::Range(0.0, 9000.0))
        ->type_name("M")
        ->capture_default_str();
    app.add_option("--report", arguments.report, "write the figures, JSON")->type_name("F.json");
    app.add_option("--frames", arguments.frames, "of the coherent flight, 100 m/s at 60 Hz")
        ->check(CLI::Range(4, 100000))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--targets", arguments.targets_px, "errors to compare at, px")
        ->check(CLI::Range(0.01, 100.0))
        ->delimiter(',')
        ->type_name("PX,...")
        ->capture_default_str();
    app.add_option("--methods", arguments.methods, "names of the methods to compare; all when not given")
        ->check(CLI::IsMember({"roam_glide", "roam", "chunked_quadtree", "geo_mipmap", "vipm_blocks", "vdpm",
                               "roam_merge_only"}))
        ->delimiter(',')
        ->type_name("NAME,...");
    add_size(app, arguments.size);
    add_threads(app, arguments.threads);
}

lod::Result<lod::Ok> run_compare(const CompareArguments& arguments) {
    if (!arguments.report.empty()) {
        if (auto writable = check_writable(arguments.report); !writable) return writable.error();
    }
    const auto grid = relief_of(arguments);
    if (!grid) return grid.error();
    CompareOptions options;
    options.sorties.width_px = arguments.size.width_px;
    options.sorties.height_px = arguments.size.height_px;
    options.sorties.frames = arguments.frames;
    options.methods.threads = arguments.threads;
    options.methods.only = arguments.methods;
    options.targets_px = arguments.targets_px;
    const auto comparison = compare_methods(*grid, options);
    if (!comparison) return comparison.error();
    std::printf("%s", table_of(*comparison).c_str());
    if (arguments.report.empty()) return lod::Ok{};
    return write_whole(arguments.report, json_of(*comparison).dump(1) + "\n");
}

}  // namespace sim
