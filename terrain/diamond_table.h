// DiamondTable: what the source data says about every diamond: its height, its error, its rise, its voids. 8 bytes
// each.
//
// The error of a triangle is the true maximum of |sample - plane| over every sample it covers, measured along
// the local vertical, plus what straight chords lose on the curved Earth. The error of a diamond is the larger
// of its two triangles', saturated: never smaller than a descendant's. Nothing is accumulated, so it is as
// tight as a per-triangle bound can be.
//
// Facts lie in pages (page_layout.h): the front works on one place at a time, so what it needs next is near, and
// a page may be absent: a table can be a window onto a store larger than memory.
//
// Sources: Duchaineau et al. 1997 (wedgies, which accumulate; these do not); Lindstrom and Pascucci 2001 for the
// saturation and for laying levels out together.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "data/height_grid.h"
#include "terrain/diamond.h"
#include "terrain/page_layout.h"

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
    float height_m = 0.0f;        ///< of the centre
    uint16_t error_code = 0;      ///< decode_length: vertical error of the two triangles, saturated
    uint16_t rise_and_voids = 0;  ///< above bit 3, a length code without its low bits; below, what is void

    static constexpr uint16_t kVoidCentre = 4;

    float error_m() const { return decode_length(error_code); }
    /// Largest height difference between the centre and a corner, rounded up.
    float rise_m() const { return decode_length(rise_and_voids & 0xfff8u); }
    void set_rise(float rise_m) {
        const unsigned code = std::min((encode_length(rise_m) + 7u) & ~7u, 0xfff8u);
        rise_and_voids = static_cast<uint16_t>(code | (rise_and_voids & 7u));
    }
    /// Whether the triangle whose apex lies in this direction covers no valid sample at all.
    bool is_half_empty(int apex_dir) const { return (rise_and_voids >> ((apex_dir >> 2) & 1) & 1) != 0; }
    void set_half_empty(int apex_dir) {
        rise_and_voids = static_cast<uint16_t>(rise_and_voids | (1u << ((apex_dir >> 2) & 1)));
    }
    bool is_void() const { return (rise_and_voids & kVoidCentre) != 0; }
};
static_assert(sizeof(DiamondSource) == 8);

/// A table, or a window onto one.
struct DiamondTable {
    static constexpr uint32_t kAbsent = 0xffffffffu;

    Domain domain;
    PageLayout layout;
    data::GroundFrame frame;           ///< where the samples lie
    float min_m = 0.0f, max_m = 0.0f;  ///< heights
    bool has_voids = false;
    DiamondSource corners[4];  ///< height and void of the domain's corners: (0,0), (side,0), (0,side), …
    std::vector<uint32_t> slot_of_page;  ///< [page] where it is; kAbsent: not here
    std::vector<DiamondSource> slots;    ///< [slot][kPageEntries]

    /// A diamond's facts, null when their page is absent. The centre must be one of this level's.
    const DiamondSource* find(GridPoint centre, int level) const {
        const PagePlace place = layout.place(centre, level);
        const uint32_t slot = slot_of_page[place.page];
        return slot == kAbsent ? nullptr : &slots[size_t(slot) * kPageEntries + place.entry];
    }
    /// The same where the page is known to be present.
    const DiamondSource& at(GridPoint centre, int level) const {
        const PagePlace place = layout.place(centre, level);
        return slots[size_t(slot_of_page[place.page]) * kPageEntries + place.entry];
    }
};

/// Everything of a table but its pages, which are all absent.
DiamondTable make_table_frame(const data::HeightGrid& grid);

/// The table of a grid. The result does not depend on the number of threads.
/// @param threads  >= 1
/// CHECKs that the grid has at least 2 x 2 and at most 32769 x 32769 samples.
/// Cost: O(n log n), under a second for 4097 x 4097 samples on two cores (terrain_bench).
DiamondTable make_diamond_table(const data::HeightGrid& grid, unsigned threads);

}  // namespace terrain
