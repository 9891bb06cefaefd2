#include "lod/progressive/coarse_mesh.h"

#include <algorithm>

#include "lod/base/check.h"

namespace lod {

CoarseMesh::CoarseMesh(const VertexHierarchy& hierarchy) {
    std::vector<std::array<uint32_t, 3>> sides;  // from, to, corner
    for (const auto& triangle : hierarchy.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            sides.push_back({triangle[k], triangle[(k + 1) % 3], static_cast<CornerId>(node_.size())});
            node_.push_back(triangle[k]);
        }
    }
    mate_.assign(node_.size(), kNoCorner);
    std::sort(sides.begin(), sides.end());
    for (size_t i = 0; i < sides.size(); ++i) {
        const auto [from, to, corner] = sides[i];
        CHECK(i == 0 || sides[i - 1][0] != from || sides[i - 1][1] != to);
        const std::array<uint32_t, 3> wanted{to, from, 0};
        const auto found = std::lower_bound(sides.begin(), sides.end(), wanted);
        if (found != sides.end() && (*found)[0] == to && (*found)[1] == from) mate_[corner] = (*found)[2];
    }
}

void CoarseMesh::fan_at(CornerId corner, Fan& out) const {
    CornerId first = corner;
    while (mate_[first] != kNoCorner) {
        first = next_corner(mate_[first]);
        if (first == corner) break;
    }
    out.corners.clear();
    out.is_closed = mate_[first] != kNoCorner;
    CornerId at = first;
    do {
        out.corners.push_back(at);
        at = mate_[prev_corner(at)];
    } while (at != kNoCorner && at != first);
}

void CoarseMesh::close_gap(CornerId one, CornerId other) {
    const CornerId a = mate_[one], b = mate_[other];
    if (a != kNoCorner) mate_[a] = b;
    if (b != kNoCorner) mate_[b] = a;
}

}  // namespace lod
