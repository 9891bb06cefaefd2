// CHECK and DCHECK: a programmer's mistake ends the program with its place; the outside world never does.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace lod {

/// Prints where and what, then aborts. Cold on purpose: the test stays one branch in the caller.
[[noreturn]] inline void check_failed(const char* file, int line, const char* condition) {
    std::fprintf(stderr, "%s:%d: CHECK failed: %s\n", file, line, condition);
    std::abort();
}

}  // namespace lod

/// Ends the program unless `condition` holds. For the borders of a module, in every build.
#define CHECK(condition) \
    (static_cast<bool>(condition) ? void(0) : lod::check_failed(__FILE__, __LINE__, #condition))

/// CHECK in debug builds only. For inner loops.
#ifdef NDEBUG
#define DCHECK(condition) void(0)
#else
#define DCHECK(condition) CHECK(condition)
#endif
