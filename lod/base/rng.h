// A small seeded generator whose numbers are the same on every machine and library.
#pragma once

#include <cstdint>

#include "lod/base/hash.h"

namespace lod {

/// Counter-based: the n-th number depends on seed and n only.
class Rng {
  public:
    explicit Rng(uint64_t seed) : state_(mix64(seed)) {}

    /// 64 uniform bits.
    uint64_t next() { return mix64(state_++); }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    /// Uniform in [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Uniform in [0, count); count > 0. The bias is below count/2^64.
    uint64_t below(uint64_t count) { return next() % count; }

  private:
    uint64_t state_;
};

}  // namespace lod
