// Runs the built program and keeps what it said.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/sim/temp_folder.h"

namespace sim_test {

struct Outcome {
    int status = -1;  ///< exit status; -1: did not end by itself
    std::string out, err;

    /// Lines on stderr that are not notes.
    int error_lines() const {
        int lines = 0;
        for (size_t at = 0; at < err.size();) {
            const size_t end = std::min(err.find('\n', at), err.size());
            lines += err.compare(at, 14, "harrier: note:") != 0;
            at = end + 1;
        }
        return lines;
    }
};

inline bool has_program() {
    return std::filesystem::exists(HARRIER_BINARY_DIR "/harrier");
}

/// @param words  as a shell would take them
inline Outcome run_program(const TempFolder& folder, const std::string& words) {
    const std::string out = folder.file("stdout"), err = folder.file("stderr");
    const std::string line = std::string(HARRIER_BINARY_DIR "/harrier ") + words + " >" + out + " 2>" + err;
    const int raw = std::system(line.c_str());
    Outcome outcome{WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, read_all(out), read_all(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return outcome;
}

/// A planar raster of 33 x 33 samples 30 m apart, hilly, as an ESRI ASCII grid.
inline std::string small_relief() {
    std::string text = "ncols 33\nnrows 33\nxllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value -9999\n";
    for (int row = 0; row < 33; ++row) {
        for (int col = 0; col < 33; ++col)
            text += std::to_string(100 + (row * row + 3 * col) % 41) + " ";
        text += "\n";
    }
    return text;
}

}  // namespace sim_test
