// What the program says on the way: progress for whoever watches, notes for everybody. Both on stderr, so that
// stdout is only what was asked for.
#pragma once

#include <unistd.h>

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

/// One line about a long step of the work, when stderr is a terminal; a log gets notes and errors only.
inline void say_progress(const std::string& line) {
    if (isatty(STDERR_FILENO)) std::fprintf(stderr, "harrier: %s\n", line.c_str());
}

/// One line about a liberty that was taken with the input.
inline void say_note(const std::string& line) {
    std::fprintf(stderr, "harrier: note: %s\n", line.c_str());
}

}  // namespace sim
