// What the program says on the way: progress for whoever watches, notes for everybody. Both on stderr, so that
// stdout is only what was asked for.
#pragma once

#include <unistd.h>

#include <atomic>
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

/// One line about a long step of the work. A terminal gets every one, a log no more than one in half a minute, so that
/// short work says nothing there.
inline void say_progress(const std::string& line) {
    constexpr int kPause_s = 30;
    static const Stopwatch watch;
    static std::atomic<int> next_s = kPause_s;
    if (!isatty(STDERR_FILENO)) {
        const int now_s = static_cast<int>(watch.seconds());
        if (now_s < next_s) return;
        next_s = now_s + kPause_s;
    }
    std::fprintf(stderr, "harrier: %s\n", line.c_str());
}

/// One line about a liberty that was taken with the input.
inline void say_note(const std::string& line) {
    std::fprintf(stderr, "harrier: note: %s\n", line.c_str());
}

}  // namespace sim
