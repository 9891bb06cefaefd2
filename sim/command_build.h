// `harrier terrain build`: turns rasters of heights into a terrain store, which is drawn without being read whole.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "lod/base/result.h"

namespace sim {

struct BuildArguments {
    std::vector<std::string> sources;
    std::string out;
    std::string voids = "fill";
    unsigned threads = 1;
};

void add_build(CLI::App& app, BuildArguments& arguments);

/// Writes the store and prints one line of JSON; progress on stderr.
lod::Result<lod::Ok> run_build(const BuildArguments& arguments);

}  // namespace sim
