// parallel_for: index ranges over a few threads; each range writes by index, so the result does not depend on
// how many threads there are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace lod {

/// Calls body(begin, end) so that the ranges cover [0, count) exactly once.
/// @param threads  at least 1; 1 runs everything on the caller
/// @param body     callable (size_t begin, size_t end); called once per thread at the most; must not throw
template <typename Body>
void parallel_for(size_t count, unsigned threads, const Body& body) {
    const size_t parts = std::clamp<size_t>(threads, 1, std::max<size_t>(count, 1));
    std::vector<std::jthread> workers;
    workers.reserve(parts - 1);
    for (size_t part = 1; part < parts; ++part) {
        workers.emplace_back(
            [&body, part, parts, count] { body(count * part / parts, count * (part + 1) / parts); });
    }
    body(size_t{0}, count / parts);
}

}  // namespace lod
