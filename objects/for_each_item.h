// Work on items of very different size: whoever of the threads is free takes the next.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "lod/base/parallel.h"

namespace objects {

/// Calls body(i) once for each i below `count`, from any thread, in any order; what it writes is by index.
template <typename Body>
void for_each_item(size_t count, unsigned threads, const Body& body) {
    std::atomic<size_t> next{0};
    const size_t workers = std::clamp<size_t>(count, 1, threads);
    lod::parallel_for(workers, static_cast<unsigned>(workers), [&](size_t, size_t) {
        for (size_t i = next++; i < count; i = next++)
            body(i);
    });
}

/// How many threads each of so few items may use for itself, when there are `threads` for all.
inline unsigned threads_within(size_t items, unsigned threads) {
    constexpr size_t kFewPerThread = 4;
    return items < kFewPerThread * threads ? threads : 1;
}

}  // namespace objects
