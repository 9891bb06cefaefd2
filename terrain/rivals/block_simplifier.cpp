#include "terrain/rivals/block_simplifier.h"

#include <bit>
#include <functional>
#include <limits>

#include "lod/base/check.h"
#include "terrain/rivals/surface_error.h"

namespace terrain {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

int shift_of(int position) {
    return std::countr_zero(static_cast<unsigned>(position));
}

bool has(const std::array<uint16_t, 3>& corners, uint16_t vertex) {
    return corners[0] == vertex || corners[1] == vertex || corners[2] == vertex;
}

/// Eight bands an octave, from a float's bits.
uint32_t band_of(float error_m) {
    return std::bit_cast<uint32_t>(error_m) >> 20;
}

}  // namespace

BlockSimplifier::BlockSimplifier(const data::HeightGrid& grid, GridPoint origin, GridPoint size)
    : grid_(grid), origin_(origin), size_(size) {
    CHECK(size.x >= 1 && size.y >= 1 && size.x <= 64 && size.y <= 64);
    vertices_.resize(static_cast<size_t>((size.x + 1) * (size.y + 1)));
    const auto at = [&](int x, int y) { return static_cast<uint16_t>(y * (size.x + 1) + x); };
    const auto add = [&](uint16_t a, uint16_t b, uint16_t c) {
        for (const uint16_t vertex : {a, b, c})
            vertices_[vertex].star.push_back(static_cast<uint16_t>(triangles_.size()));
        Triangle& triangle = triangles_.emplace_back();
        triangle.corners = {a, b, c};
        triangle.fan_error_m = triangle.error_m = error_m(cell_triangle(triangle.corners));
    };
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const bool is_even = ((origin.x + x + origin.y + y) & 1) == 0;
            add(at(x, y), at(x, y + 1), is_even ? at(x + 1, y + 1) : at(x + 1, y));
            add(at(x + 1, y + 1), at(x + 1, y), is_even ? at(x, y) : at(x, y + 1));
        }
    }
    active_triangles_ = static_cast<uint32_t>(triangles_.size());
    for (size_t side = 0; side < 4; ++side) {
        const int end = (side & 1) == 0 ? size.x : size.y;
        for (int position = 1; position < end; ++position)
            ++on_side_[side][static_cast<size_t>(shift_of(position))];
    }
}

float BlockSimplifier::error_m(const CellTriangle& t) const {
    const auto at = [&](GridPoint p) { return GridPoint{origin_.x + p.x, origin_.y + p.y}; };
    return surface_error_m(grid_, at(t[0]), at(t[1]), at(t[2]));
}

/// The worst over all fans that neighbours may ask for: every spacing on every side that the triangle touches.
float BlockSimplifier::fan_error_m(const CellTriangle& t) const {
    int top[4] = {0, 0, 0, 0};  // shifts to be tried on a side, beside none at all
    for (size_t i = 0; i < 3; ++i) {
        const GridPoint a = t[i], b = t[(i + 1) % 3];
        const int side = common_side(size_, a, b);
        if (side < 0) continue;
        const int length = std::abs(along_side(side, a) - along_side(side, b));
        while (1 << top[side] < length)
            ++top[side];
    }
    float worst = 0.0f;
    if (top[0] + top[1] + top[2] + top[3] == 0) return worst;
    std::array<uint8_t, 4> shift;
    const std::function<void(size_t)> try_side = [&](size_t side) {
        if (side == 4) {
            fan_border(size_, t, shift,
                       [&](const CellTriangle& part) { worst = std::max(worst, error_m(part)); });
            return;
        }
        for (int s = 0; s <= top[side]; ++s) {
            shift[side] = s < top[side] ? static_cast<uint8_t>(s) : kBareShift;
            try_side(side + 1);
        }
    };
    try_side(0);
    return worst;
}

/// The side a vertex lies on, 4 in a corner of the block, -1 inside.
int BlockSimplifier::side_of(uint16_t vertex) const {
    const GridPoint p = place(vertex);
    const bool is_on_x = p.x == 0 || p.x == size_.x, is_on_y = p.y == 0 || p.y == size_.y;
    return is_on_x && is_on_y ? 4 : common_side(size_, p, p);
}

/// On a side, no vertex at a finer power of two may be left.
bool BlockSimplifier::is_allowed(uint16_t vertex, int side) const {
    if (side < 0) return true;
    if (side == 4) return false;
    const int shift = shift_of(along_side(side, place(vertex)));
    for (int finer = 0; finer < shift; ++finer) {
        if (on_side_[static_cast<size_t>(side)][static_cast<size_t>(finer)] > 0) return false;
    }
    return true;
}

/// Error of the triangles that are left with `target` in the vertex's place; infinite when one would be empty or
/// fold over, or when the limit is reached.
float BlockSimplifier::collapse_cost_m(uint16_t vertex, uint16_t target, float limit_m) const {
    float cost_m = 0.0f;
    for (const uint16_t index : vertices_[vertex].star) {
        std::array<uint16_t, 3> corners = triangles_[index].corners;
        if (has(corners, target)) continue;
        for (uint16_t& corner : corners) {
            if (corner == vertex) corner = target;
        }
        const CellTriangle t = cell_triangle(corners);
        if (twice_area(t[0], t[1], t[2]) <= 0) return kInfinity;
        cost_m = std::max(cost_m, error_m(t));
        if (cost_m >= limit_m) return kInfinity;
    }
    return cost_m;
}

/// Finds a vertex's cheapest target; returns the cost, infinite when there is none.
float BlockSimplifier::rank(uint16_t vertex) {
    Vertex& v = vertices_[vertex];
    v.is_stale = false;
    v.target = kNoTarget;
    const int side = side_of(vertex);
    if (!is_allowed(vertex, side)) return kInfinity;
    neighbours_.clear();
    for (const uint16_t index : v.star) {
        for (const uint16_t corner : triangles_[index].corners) {
            if (corner != vertex && (side < 0 || common_side(size_, place(vertex), place(corner)) == side))
                neighbours_.push_back(corner);
        }
    }
    std::sort(neighbours_.begin(), neighbours_.end());
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    float best_m = kInfinity;
    for (const uint16_t target : neighbours_) {
        const float cost_m = collapse_cost_m(vertex, target, best_m);
        if (cost_m >= best_m) continue;
        best_m = cost_m;
        v.target = target;
    }
    return best_m;
}

void BlockSimplifier::enqueue(uint16_t vertex, float cost_m) {
    vertices_[vertex].is_queued = true;
    queue_.push_back({cost_m, vertex});
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void BlockSimplifier::run() {
    add_stop();
    for (uint16_t vertex = 0; vertex < vertices_.size(); ++vertex) {
        const float cost_m = rank(vertex);
        if (cost_m < kInfinity) enqueue(vertex, cost_m);
    }
    uint32_t band = 0;  // of errors that are exactly 0
    while (!queue_.empty()) {
        std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
        const Candidate best = queue_.back();
        queue_.pop_back();
        Vertex& v = vertices_[best.vertex];
        v.is_queued = false;
        if (v.is_stale) {
            const float cost_m = rank(best.vertex);
            if (cost_m < kInfinity) enqueue(best.vertex, cost_m);
            continue;
        }
        if (band_of(best.cost_m) > band) {
            add_stop();
            band = band_of(best.cost_m);
        }
        collapse(best.vertex, v.target, best.cost_m);
    }
    add_stop();
}

void BlockSimplifier::collapse(uint16_t vertex, uint16_t target, float cost_m) {
    Collapse record{vertex, target};
    Vertex& v = vertices_[vertex];
    v.is_gone = true;
    for (const uint16_t index : v.star) {
        Triangle& triangle = triangles_[index];
        for (const uint16_t corner : triangle.corners) {
            Vertex& other = vertices_[corner];
            other.is_stale = true;
            if (!other.is_queued && !other.is_gone) enqueue(corner, cost_m);
        }
        if (has(triangle.corners, target)) {
            triangle.is_gone = true;
            for (const uint16_t corner : triangle.corners) {
                if (corner != vertex) std::erase(vertices_[corner].star, index);
            }
            removed_.push_back(index);
            --active_triangles_;
            continue;
        }
        for (uint16_t& corner : triangle.corners) {
            if (corner == vertex) corner = target;
        }
        triangle.error_m = error_m(cell_triangle(triangle.corners));
        triangle.fan_error_m = -1.0f;
        vertices_[target].star.push_back(index);
        fixed_.push_back(index);
        ++record.fixed;
    }
    v.star.clear();
    collapses_.push_back(record);
    leave_side(vertex, cost_m);
}

/// A vertex has gone from a side: when it was the last of its power of two, the next ones may go.
void BlockSimplifier::leave_side(uint16_t vertex, float cost_m) {
    const int side = side_of(vertex);
    if (side < 0) return;
    const int shift = shift_of(along_side(side, place(vertex)));
    auto& left = on_side_[static_cast<size_t>(side)];
    if (--left[static_cast<size_t>(shift)] > 0) return;
    for (uint16_t other = 0; other < vertices_.size(); ++other) {
        if (vertices_[other].is_gone || vertices_[other].is_queued || side_of(other) != side) continue;
        vertices_[other].is_stale = true;
        enqueue(other, cost_m);
    }
}

void BlockSimplifier::add_stop() {
    if (!stops_.empty() && stops_.back().splits == collapses_.size()) return;
    ProgressiveBlock::Stop& stop = stops_.emplace_back();
    stop.splits = static_cast<uint32_t>(collapses_.size());
    stop.fixes = static_cast<uint32_t>(fixed_.size());
    stop.triangles = active_triangles_;
    for (Triangle& triangle : triangles_) {
        if (triangle.is_gone) continue;
        if (triangle.fan_error_m < 0.0f) triangle.fan_error_m = fan_error_m(cell_triangle(triangle.corners));
        stop.error_m = std::max({stop.error_m, triangle.error_m, triangle.fan_error_m});
    }
    if (stop.splits == 0) stop.error_m = 0.0f;  // the source itself
    for (size_t side = 0; side < 4; ++side) {
        stop.border_shift[side] = kBareShift;
        for (size_t shift = kBareShift; shift-- > 0;) {
            stop.border_points[side] = static_cast<uint8_t>(stop.border_points[side] + on_side_[side][shift]);
            if (on_side_[side][shift] > 0) stop.border_shift[side] = static_cast<uint8_t>(shift);
        }
    }
}

/// New numbers: what is left first, then what went last.
BlockSimplifier::Numbers BlockSimplifier::renumber() const {
    Numbers numbers{std::vector<uint16_t>(vertices_.size()), std::vector<uint16_t>(triangles_.size())};
    uint16_t next = 0;
    for (size_t i = 0; i < vertices_.size(); ++i) {
        if (!vertices_[i].is_gone) numbers.vertex[i] = next++;
    }
    for (size_t i = collapses_.size(); i-- > 0;)
        numbers.vertex[collapses_[i].vertex] = next++;
    next = 0;
    for (size_t i = 0; i < triangles_.size(); ++i) {
        if (!triangles_[i].is_gone) numbers.triangle[i] = next++;
    }
    for (size_t i = removed_.size(); i-- > 0;)
        numbers.triangle[removed_[i]] = next++;
    return numbers;
}

ProgressiveBlock BlockSimplifier::result() const {
    const Numbers numbers = renumber();
    const auto collapse_count = static_cast<uint32_t>(collapses_.size());
    ProgressiveBlock block;
    block.origin = origin_;
    block.size = size_;
    block.base_vertices = static_cast<uint32_t>(vertices_.size()) - collapse_count;
    block.places.resize(vertices_.size());
    block.rim_vertex.resize(4 * 65);
    for (size_t i = 0; i < vertices_.size(); ++i) {
        const GridPoint p = place(static_cast<uint16_t>(i));
        block.places[numbers.vertex[i]] = {static_cast<uint8_t>(p.x), static_cast<uint8_t>(p.y)};
        const bool is_on[4] = {p.y == 0, p.x == size_.x, p.y == size_.y, p.x == 0};
        for (int side = 0; side < 4; ++side) {
            if (is_on[side])
                block.rim_vertex[static_cast<size_t>(side * 65 + along_side(side, p))] = numbers.vertex[i];
        }
    }
    block.corners.resize(triangles_.size());
    for (size_t i = 0; i < triangles_.size(); ++i) {
        for (size_t k = 0; k < 3; ++k)
            block.corners[numbers.triangle[i]][k] = numbers.vertex[triangles_[i].corners[k]];
    }
    for (size_t i = fixed_.size(); i-- > 0;)
        block.fixes.push_back(numbers.triangle[fixed_[i]]);
    for (size_t i = collapses_.size(); i-- > 0;)
        block.splits.push_back({numbers.vertex[collapses_[i].target], collapses_[i].fixed});
    for (size_t i = stops_.size(); i-- > 0;) {
        ProgressiveBlock::Stop& stop = block.stops.emplace_back(stops_[i]);
        stop.splits = collapse_count - stop.splits;
        stop.fixes = static_cast<uint32_t>(fixed_.size()) - stop.fixes;
    }
    return block;
}

ProgressiveBlock make_progressive_block(const data::HeightGrid& grid, GridPoint origin, GridPoint size) {
    BlockSimplifier simplifier(grid, origin, size);
    simplifier.run();
    return simplifier.result();
}

}  // namespace terrain
