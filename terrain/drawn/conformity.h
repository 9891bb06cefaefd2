// Whether drawn triangles are conforming, judged on the integer grid coordinates of what the draw list holds, with
// no help from any mesh's own bookkeeping.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lod/base/hash.h"
#include "terrain/drawn/drawn_mesh.h"

namespace terrain::drawn {

inline uint64_t key_of(GridPoint p) {
    return static_cast<uint64_t>(p.y) << 32 | static_cast<uint64_t>(p.x);
}

/// A directed edge.
using Edge = std::pair<GridPoint, GridPoint>;
struct EdgeHash {
    size_t operator()(const Edge& edge) const {
        return lod::mix64(key_of(edge.first) ^ lod::mix64(key_of(edge.second)));
    }
};

/// Twice the area, in cells; positive when counter-clockwise seen from above (rows run south).
inline int64_t area_of(const DrawnTriangle& t) {
    const auto& s = t.samples;
    return int64_t{s[2].x - s[0].x} * (s[1].y - s[0].y) - int64_t{s[1].x - s[0].x} * (s[2].y - s[0].y);
}

inline int64_t area_of(const std::vector<DrawnTriangle>& triangles) {
    int64_t area = 0;
    for (const DrawnTriangle& triangle : triangles)
        area += area_of(triangle);
    return area;
}

/// The vertex that lies strictly inside an edge, if one does.
inline std::optional<GridPoint> vertex_inside(GridPoint a, GridPoint b,
                                              const std::unordered_map<uint64_t, int>& vertices) {
    const int steps = std::gcd(std::abs(b.x - a.x), std::abs(b.y - a.y));
    for (int i = 1; i < steps; ++i) {
        const GridPoint p{a.x + (b.x - a.x) / steps * i, a.y + (b.y - a.y) / steps * i};
        if (vertices.count(key_of(p)) > 0) return p;
    }
    return std::nullopt;
}

inline std::string text(GridPoint p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
}

/// What stands upright covers no ground: skirts.
inline std::vector<DrawnTriangle> without_skirts(const std::vector<DrawnTriangle>& triangles) {
    std::vector<DrawnTriangle> ground;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(ground),
                 [](const DrawnTriangle& triangle) { return area_of(triangle) != 0; });
    return ground;
}

/// Edges with a triangle on one side only and a drawn vertex strictly inside: where a gap can open.
inline size_t count_t_junctions(const std::vector<DrawnTriangle>& triangles) {
    std::unordered_map<uint64_t, int> vertices;
    std::unordered_map<Edge, int, EdgeHash> edges;
    for (const DrawnTriangle& t : triangles) {
        for (size_t i = 0; i < 3; ++i) {
            ++vertices[key_of(t.samples[i])];
            ++edges[{t.samples[i], t.samples[(i + 1) % 3]}];
        }
    }
    size_t count = 0;
    for (const DrawnTriangle& t : triangles) {
        for (size_t i = 0; i < 3; ++i) {
            const GridPoint a = t.samples[i], b = t.samples[(i + 1) % 3];
            if (edges.count({b, a}) == 0 && vertex_inside(a, b, vertices)) ++count;
        }
    }
    return count;
}

/// Empty when the triangles are conforming: every directed edge once, none folded over or empty, and no vertex
/// inside an edge that has a triangle on one side only.
inline std::string conformity_fault(const std::vector<DrawnTriangle>& triangles) {
    std::unordered_map<uint64_t, int> vertices;
    std::unordered_map<Edge, int, EdgeHash> edges;
    for (const DrawnTriangle& t : triangles) {
        if (area_of(t) <= 0) return "a triangle at " + text(t.samples[0]) + " is empty or upside down";
        for (size_t i = 0; i < 3; ++i) {
            ++vertices[key_of(t.samples[i])];
            if (++edges[{t.samples[i], t.samples[(i + 1) % 3]}] > 1)
                return "two triangles on one side of the edge at " + text(t.samples[i]);
        }
    }
    for (const DrawnTriangle& t : triangles) {
        for (size_t i = 0; i < 3; ++i) {
            const GridPoint a = t.samples[i], b = t.samples[(i + 1) % 3];
            if (edges.count({b, a}) > 0) continue;
            if (const auto p = vertex_inside(a, b, vertices)) {
                return "T-junction: " + text(*p) + " inside " + text(a) + " to " + text(b);
            }
        }
    }
    return "";
}

}  // namespace terrain::drawn
