// How often the test program has asked for memory: for what must not, once warm.
#pragma once

#include <cstdint>

namespace lod_test {

/// Calls of operator new since the start (counted in rigid_front_test.cpp).
uint64_t allocation_count();

}  // namespace lod_test
