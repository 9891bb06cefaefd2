// `harrier terrain extract`: a static mesh of a raster of heights, with a guaranteed error, for other programs.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "lod/base/result.h"

namespace sim {

struct ExtractArguments {
    std::string source;
    double max_error_m = 1.0;
    std::string out;
    std::string voids = "hole";
};

void add_extract(CLI::App& app, ExtractArguments& arguments);

/// Writes PLY (x and y in the raster's CRS, heights in metres as the source has them) and prints one line of JSON.
lod::Result<lod::Ok> run_extract(const ExtractArguments& arguments);

}  // namespace sim
