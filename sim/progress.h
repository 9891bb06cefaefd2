// Progress: one line on stderr per long step of the work, with what it found and how long it took.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace sim {

/// Seconds since it was made.
class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }
    double ms() const { return seconds() * 1e3; }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Writes "harrier: line" to stderr.
inline void say(const std::string& line) {
    std::fprintf(stderr, "harrier: %s\n", line.c_str());
}

}  // namespace sim
