// Values on the command line that are more than one word or number: sizes, positions, thread counts.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sim {

struct Size {
    int width_px = 640, height_px = 360;
};

/// "WxH", both 1 to 16384; false when it is not.
bool parse_size(const std::string& text, Size& out);

/// "A,B,C" of exactly `count` finite numbers; false when it is not.
bool parse_numbers(const std::string& text, size_t count, std::vector<double>& out);

/// Adds an option of this kind; what does not parse is a usage error.
CLI::Option* add_size(CLI::App& app, Size& out);
CLI::Option* add_numbers(CLI::App& app, const std::string& name, std::vector<double>& out, size_t count,
                         const std::string& description);

/// --batch K; the default is what measured best (docs/batched_leaves.md).
CLI::Option* add_batch(CLI::App& app, int& out);

/// --threads N; the default is what the machine has.
CLI::Option* add_threads(CLI::App& app, unsigned& out);

}  // namespace sim
