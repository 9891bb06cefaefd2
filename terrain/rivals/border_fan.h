// Fans along a block's border: a triangle is split so that its edges on the border meet a finer neighbour's.
#pragma once

#include <array>
#include <cstdint>

#include "terrain/rivals/block_patterns.h"

namespace terrain {

/// The side (block_grid.h) both points lie on, or -1. Points in cells from the block's north-west sample.
inline int common_side(GridPoint size, GridPoint a, GridPoint b) {
    if (a.y == 0 && b.y == 0) return 0;
    if (a.x == size.x && b.x == size.x) return 1;
    if (a.y == size.y && b.y == size.y) return 2;
    if (a.x == 0 && b.x == 0) return 3;
    return -1;
}

/// A point's position along a side: its column on the north and south sides, its row on the others.
inline int along_side(int side, GridPoint p) {
    return (side & 1) == 0 ? p.x : p.y;
}

/// A shift whose spacing puts no vertex between the ends of a side of up to 64 cells.
inline constexpr int kBareShift = 7;

/// Hands out the triangle in parts such that every multiple of 1 << shift[side] inside an edge along that side is a
/// corner. New corners lie on the border only.
template <typename Emit>
void fan_border(GridPoint size, const CellTriangle& t, const std::array<uint8_t, 4>& shift,
                const Emit& emit) {
    for (size_t i = 0; i < 3; ++i) {
        const GridPoint a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        const int side = common_side(size, a, b);
        if (side < 0) continue;
        const int s = shift[static_cast<size_t>(side)];
        const int from = along_side(side, a), to = along_side(side, b);
        const int first = (std::min(from, to) >> s) + 1, last = (std::max(from, to) - 1) >> s;
        if (first > last) continue;
        const int middle = (first + last) / 2 << s;
        const GridPoint p = (side & 1) == 0 ? GridPoint{middle, a.y} : GridPoint{a.x, middle};
        fan_border(size, {a, p, c}, shift, emit);
        fan_border(size, {p, b, c}, shift, emit);
        return;
    }
    emit(t);
}

}  // namespace terrain
