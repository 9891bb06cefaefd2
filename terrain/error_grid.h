// ErrorGrid: for every diamond, how far the source surface may be from the two triangles drawn there.
//
// The error of a triangle is the true maximum of |sample - plane| over every sample it covers, measured along
// the local vertical, plus what straight chords lose on the curved Earth. The error of a diamond is the larger
// of its two triangles', saturated: never smaller than a descendant's. Nothing is accumulated, so it is as
// tight as a per-triangle bound can be. Two bytes a vertex: a 16-bit logarithm, rounded up (0.05 %).
//
// Source: Duchaineau et al. 1997 (wedgies, which accumulate; these do not); Lindstrom and Pascucci 2001 for the
// saturation.
#pragma once

#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "data/height_grid.h"
#include "terrain/diamond.h"

namespace terrain {

/// Metres to the 16-bit code, rounded up; 0 only for 0. Anything below 0.12 mm becomes 0.12 mm; above 524 km
/// saturates.
uint16_t encode_error(float error_m);

/// Metres of a code; decode(encode(x)) is in [x, 1.0005 x] for 0.12 mm <= x <= 524 km.
inline float decode_error(uint16_t code) {
    constexpr uint32_t kBase = (127u - 13u) << 11;
    return code == 0 ? 0.0f : std::bit_cast<float>((kBase + code - 1u) << 12);
}

/// Which of a diamond's triangles cover no valid sample at all: bit 0 for the triangle whose apex lies in a
/// direction 0..3, bit 1 for 4..7.
inline int half_bit(int apex_dir) {
    return (apex_dir >> 2) & 1;
}

struct ErrorGrid {
    Domain domain;
    std::vector<uint16_t> code;         ///< [height * width], by centre
    std::vector<uint8_t> empty_halves;  ///< [height * width], see half_bit; empty without voids
    std::unordered_map<uint64_t, uint16_t>
        outside;  ///< centres beyond the raster whose triangles reach into it

    static uint64_t outside_key(GridPoint p) {
        return (static_cast<uint64_t>(p.y) << 32) | static_cast<uint64_t>(p.x);
    }

    /// Error of the diamond centred at p, metres; 0 for those that reach no sample. p must be in the domain.
    float error_m(GridPoint p) const {
        if (domain.in_raster(p)) {
            return decode_error(code[static_cast<size_t>(p.y) * static_cast<size_t>(domain.width) +
                                     static_cast<size_t>(p.x)]);
        }
        const auto found = outside.find(outside_key(p));
        return found == outside.end() ? 0.0f : decode_error(found->second);
    }
};

/// Errors of the whole grid. The result does not depend on the number of threads.
/// @param threads  >= 1
/// CHECKs that the grid has at least 2 x 2 and at most 32769 x 32769 samples.
/// Cost: O(n log n), under a second for 4097 x 4097 samples on two cores (terrain_bench).
ErrorGrid compute_errors(const data::HeightGrid& grid, unsigned threads);

}  // namespace terrain
