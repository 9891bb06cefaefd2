// DiamondTable: what the source data says about every diamond: its height, its error, its rise. 8 bytes each.
//
// The error of a triangle is the true maximum of |sample - plane| over every sample it covers, measured along
// the local vertical, plus what straight chords lose on the curved Earth. The error of a diamond is the larger
// of its two triangles', saturated: never smaller than a descendant's. Nothing is accumulated, so it is as
// tight as a per-triangle bound can be.
//
// Diamonds of one level lie together in memory, row by row, so that the front, which works on one level in one
// place at a time, finds neighbours in one cache line and needs one access for everything about a diamond:
//
//     square levels   centres at odd multiples of reach        row = y / (2 reach), column = x / (2 reach)
//     turned levels   one coordinate odd, one even multiple     row = y / reach,     column = x / (2 reach)
//
// Sources: Duchaineau et al. 1997 (wedgies, which accumulate; these do not); Lindstrom and Pascucci 2001 for the
// saturation and for laying levels out together.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "data/height_grid.h"
#include "terrain/diamond.h"

namespace terrain {

/// Metres to a 16-bit logarithm, rounded up; 0 only for 0. Anything below 0.12 mm becomes 0.12 mm; above 524 km
/// saturates.
uint16_t encode_length(float length_m);

/// Metres of a code; decode(encode(x)) is in [x, 1.0005 x] for 0.12 mm <= x <= 524 km.
inline float decode_length(uint16_t code) {
    constexpr uint32_t kBase = (127u - 13u) << 11;
    return code == 0 ? 0.0f : std::bit_cast<float>((kBase + code - 1u) << 12);
}

/// One diamond's facts.
struct DiamondSource {
    float height_m = 0.0f;    ///< of the centre
    uint16_t error_code = 0;  ///< decode_length: vertical error of the two triangles, saturated
    uint16_t rise_code = 0;   ///< decode_length: largest height difference between the centre and a corner

    float error_m() const { return decode_length(error_code); }
    float rise_m() const { return decode_length(rise_code); }
};
static_assert(sizeof(DiamondSource) == 8);

/// Which of a diamond's triangles cover no valid sample at all: bit 0 for the triangle whose apex lies in a
/// direction 0..3, bit 1 for 4..7.
inline int half_bit(int apex_dir) {
    return (apex_dir >> 2) & 1;
}

struct DiamondTable {
    /// Where a level's rows are.
    struct Level {
        size_t first = 0;      ///< index of row 0, column 0
        size_t columns = 0;    ///< per row
        int row_shift = 0;     ///< row = y >> row_shift
        int column_shift = 0;  ///< column = x >> column_shift
    };

    Domain domain;
    std::vector<Level> levels;
    std::vector<DiamondSource> sources;  ///< by index()
    std::vector<uint8_t> empty_halves;   ///< by index(), see half_bit; empty when the grid has no voids

    /// Index of a diamond of the domain; its centre must be one of this level's.
    size_t index(GridPoint centre, int level) const {
        const Level& l = levels[static_cast<size_t>(level)];
        return l.first + static_cast<size_t>(centre.y >> l.row_shift) * l.columns +
               static_cast<size_t>(centre.x >> l.column_shift);
    }
    const DiamondSource& at(GridPoint centre, int level) const { return sources[index(centre, level)]; }
};

/// The table of a grid. The result does not depend on the number of threads.
/// @param threads  >= 1
/// CHECKs that the grid has at least 2 x 2 and at most 32769 x 32769 samples.
/// Cost: O(n log n), under a second for 4097 x 4097 samples on two cores (terrain_bench).
DiamondTable make_diamond_table(const data::HeightGrid& grid, unsigned threads);

}  // namespace terrain
