#include "terrain/rivals/block_patterns.h"

namespace terrain {
namespace {

/// Clamps, turns counter-clockwise, and drops what is squeezed to nothing.
void add(const BlockShape& shape, const CellTriangle& corners, std::vector<CellTriangle>& out) {
    CellTriangle t = corners;
    for (GridPoint& p : t)
        p = {std::min(p.x, shape.size.x), std::min(p.y, shape.size.y)};
    const int64_t area = twice_area(t[0], t[1], t[2]);
    if (area < 0) std::swap(t[1], t[2]);
    if (area != 0) out.push_back(t);
}

/// Both halves of a cell of width s.
void add_cell(const BlockShape& shape, GridPoint at, int s, std::vector<CellTriangle>& out) {
    const GridPoint nw = at, ne{at.x + s, at.y}, sw{at.x, at.y + s}, se{at.x + s, at.y + s};
    if (((at.x / s + at.y / s) & 1) == 0) {
        add(shape, {nw, sw, se}, out);
        add(shape, {nw, se, ne}, out);
    } else {
        add(shape, {nw, sw, ne}, out);
        add(shape, {ne, sw, se}, out);
    }
}

/// The point t along a side, clockwise, and `deep` inwards.
GridPoint on_side(int cells, int side, int t, int deep) {
    switch (side) {
        case 0:
            return {t, deep};
        case 1:
            return {cells - deep, t};
        case 2:
            return {cells - t, cells - deep};
        default:
            return {deep, cells - t};
    }
}

}  // namespace

void add_inner(const BlockShape& shape, int shift, std::vector<CellTriangle>& out) {
    const int s = 1 << shift;
    for (int y = s; y < shape.cells - s && y < shape.size.y; y += s) {
        for (int x = s; x < shape.cells - s && x < shape.size.x; x += s)
            add_cell(shape, {x, y}, s, out);
    }
}

void add_strip(const BlockShape& shape, int side, int shift, int outer_shift,
               std::vector<CellTriangle>& out) {
    const int s = 1 << shift, wide = 1 << outer_shift, cells = shape.cells;
    const bool is_plain = outer_shift == shift;
    const auto outer = [&](int t) { return on_side(cells, side, t, 0); };
    const auto inner = [&](int t) { return on_side(cells, side, t, s); };
    for (int t = 0; t < cells; t += wide) {
        const bool is_even = (t / s & 1) == 0;
        const int apex = is_plain ? (is_even ? t + s : t) : t + wide / 2;
        add(shape, {outer(t), outer(t + wide), inner(apex)}, out);
    }
    // Inner edges are joined with the nearest vertex of the outer line; unstitched, with the nearest even one.
    const int step = is_plain ? 2 * s : wide;
    for (int t = s; t + s < cells; t += s) {
        const int nearest = (2 * t + s + step) / (2 * step) * step;
        add(shape, {outer(nearest), inner(t), inner(t + s)}, out);
    }
}

void add_plain(const BlockShape& shape, int shift, std::vector<CellTriangle>& out) {
    if (shift == shape.top_shift()) {
        add_cell(shape, {0, 0}, shape.cells, out);
        return;
    }
    add_inner(shape, shift, out);
    for (int side = 0; side < 4; ++side)
        add_strip(shape, side, shift, shift, out);
}

}  // namespace terrain
