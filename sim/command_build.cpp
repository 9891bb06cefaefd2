#include "sim/command_build.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "data/height_grid.h"
#include "sim/command_values.h"
#include "sim/progress.h"
#include "sim/whole_file.h"
#include "terrain/store/store_builder.h"

namespace sim {

void add_build(CLI::App& app, BuildArguments& arguments) {
    app.add_option("dem", arguments.sources, "rasters of heights, joined on the grid of the first")
        ->required()
        ->type_name("DEM...");
    app.add_option("--out", arguments.out, "terrain store to write")->required()->type_name("F.hts");
    app.add_option("--voids", arguments.voids, "samples without a height become a hole, or are filled")
        ->check(CLI::IsMember({"hole", "fill"}))
        ->capture_default_str();
    add_threads(app, arguments.threads);
}

lod::Result<lod::Ok> run_build(const BuildArguments& arguments) {
    if (auto writable = check_writable(arguments.out); !writable) return writable.error();
    const Stopwatch watch;
    say_progress(fmt::format("reading {} rasters", arguments.sources.size()));
    data::HeightGridOptions reading;
    reading.voids = arguments.voids == "hole" ? data::VoidPolicy::kHole : data::VoidPolicy::kFill;
    const auto grid = data::read_height_grid(arguments.sources, reading);
    if (!grid) return grid.error();
    const double reading_s = watch.seconds();
    say_progress(fmt::format("{} x {} samples read in {:.1f} s", grid->width, grid->height, reading_s));
    const auto built = terrain::build_store(*grid, arguments.out, arguments.threads, [&](double share) {
        say_progress(fmt::format("store: {:3.0f} %, {:.1f} s", 100.0 * share, watch.seconds()));
    });
    if (!built) return built.error();
    const nlohmann::json json = {{"width", grid->width},       {"height", grid->height},
                                 {"pages", built->page_count}, {"bytes", built->file_bytes},
                                 {"reading_s", reading_s},     {"total_s", watch.seconds()}};
    std::printf("%s\n", json.dump().c_str());
    return lod::Ok{};
}

}  // namespace sim
