// `harrier terrain query`: heights of the ground and lines of sight over it, asked of the source data.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "lod/base/result.h"

namespace sim {

struct QueryArguments {
    std::vector<std::string> sources;
    std::string points = "-";  ///< "-": standard input
    std::vector<double> from, to;
    bool above_ground = false;
    std::string voids = "hole";
    unsigned threads = 2;
};

void add_query(CLI::App& app, QueryArguments& arguments);

/// Prints one line of JSON for each question, in their order; nothing when one of them is bad.
lod::Result<lod::Ok> run_query(const QueryArguments& arguments);

}  // namespace sim
