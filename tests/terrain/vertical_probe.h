// VerticalProbe: which drawn triangle lies straight above or below a place, along the ellipsoid's normal.
//
// A grid of buckets, filled by the columns and rows the vertices claim to lie on, only proposes candidates; what
// is above what is decided in world coordinates, in double precision.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/terrain/drawn_mesh.h"

namespace terrain_test {

struct VerticalHit {
    bool found = false;
    double above_m = 0.0;                                       ///< of the surface above the place
    double beside_m = std::numeric_limits<double>::infinity();  ///< 0: inside a triangle, else how far off
};

class VerticalProbe {
  public:
    VerticalProbe(int width, int height, double cell_m, const std::vector<DrawnTriangle>& triangles)
        : columns_(width / kCells + 1), rows_(height / kCells + 1), triangles_(triangles) {
        begin_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
        boxes_.reserve(triangles.size());
        for (const DrawnTriangle& triangle : triangles)
            boxes_.push_back(box_of(triangle, width, height, cell_m));
        for (const Box& box : boxes_)
            for_buckets(box, [&](size_t bucket) { ++begin_[bucket + 1]; });
        for (size_t i = 1; i < begin_.size(); ++i)
            begin_[i] += begin_[i - 1];
        members_.resize(begin_.back());
        std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (uint32_t i = 0; i < boxes_.size(); ++i)
            for_buckets(boxes_[i], [&](size_t bucket) { members_[next[bucket]++] = i; });
    }

    /// @param col, row  nearest sample of the place @param at  world  @param up  unit length
    VerticalHit probe(int col, int row, const glm::dvec3& at, const glm::dvec3& up) const {
        VerticalHit best;
        const size_t bucket = static_cast<size_t>(row / kCells) * static_cast<size_t>(columns_) +
                              static_cast<size_t>(col / kCells);
        for (uint32_t i = begin_[bucket]; i < begin_[bucket + 1]; ++i) {
            const Box& box = boxes_[members_[i]];
            if (col < box.left || col > box.right || row < box.top || row > box.bottom) continue;
            meet(triangles_[members_[i]], at, up, best);
            if (best.beside_m == 0.0) break;
        }
        return best;
    }

  private:
    static constexpr int kCells = 4;
    struct Box {
        int left, top, right, bottom;
    };

    /// Straight edges leave the curved grid sideways: by less than n^2 cell / (4 R), in cells.
    static Box box_of(const DrawnTriangle& triangle, int width, int height, double cell_m) {
        Box box{width, height, 0, 0};
        for (const terrain::GridPoint& p : triangle.samples) {
            box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x),
                   std::max(box.bottom, p.y)};
        }
        const double n = std::hypot(box.right - box.left, box.bottom - box.top);
        const int margin = 1 + static_cast<int>(n * n * cell_m / (4.0 * 6.37e6));
        return {std::max(box.left - margin, 0), std::max(box.top - margin, 0),
                std::min(box.right + margin, width - 1), std::min(box.bottom + margin, height - 1)};
    }

    template <typename Visit>
    void for_buckets(const Box& box, const Visit& visit) const {
        for (int y = box.top / kCells; y <= box.bottom / kCells; ++y) {
            for (int x = box.left / kCells; x <= box.right / kCells; ++x)
                visit(static_cast<size_t>(y) * static_cast<size_t>(columns_) + static_cast<size_t>(x));
        }
    }

    /// Improves `best` if the vertical through the place passes the triangle, or passes it nearer.
    static void meet(const DrawnTriangle& triangle, const glm::dvec3& at, const glm::dvec3& up,
                     VerticalHit& best) {
        const glm::dvec3 a = triangle.world[0] - at, b = triangle.world[1] - at, c = triangle.world[2] - at;
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double area = glm::dot(up, normal);
        if (!(area > 0.0)) return;  // stands upright, or upside down
        const glm::dvec3 corners[4] = {a, b, c, a};
        double beside = 0.0;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 edge = corners[i + 1] - corners[i];
            const double level = glm::length(edge - up * glm::dot(edge, up));
            beside = std::max(beside, -glm::dot(up, glm::cross(corners[i], corners[i + 1])) / level);
        }
        if (beside < kRounding_m) beside = 0.0;
        if (beside < best.beside_m) best = {true, glm::dot(a, normal) / area, beside};
    }

    static constexpr double kRounding_m = 1e-4;  // a sample on an edge is in the triangles on both sides
    int columns_, rows_;
    const std::vector<DrawnTriangle>& triangles_;
    std::vector<Box> boxes_;
    std::vector<uint32_t> begin_, members_;  ///< triangles of bucket b: members_[begin_[b] .. begin_[b + 1])
};

}  // namespace terrain_test
