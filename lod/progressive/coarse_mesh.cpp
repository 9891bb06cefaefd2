#include "lod/progressive/coarse_mesh.h"

#include "lod/base/check.h"

namespace lod {

CoarseMesh::CoarseMesh(std::span<const std::array<NodeId, 3>> triangles, uint32_t leaf_count) {
    node_.reserve(3 * triangles.size());
    std::vector<uint32_t> begin(leaf_count + 1, 0);  // into leaving
    for (const auto& triangle : triangles) {
        for (NodeId leaf : triangle) {
            node_.push_back(leaf);
            ++begin[leaf + 1];
        }
    }
    for (uint32_t leaf = 0; leaf < leaf_count; ++leaf)
        begin[leaf + 1] += begin[leaf];
    std::vector<CornerId> leaving(node_.size());
    std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
    for (CornerId corner = 0; corner < node_.size(); ++corner)
        leaving[next[node_[corner]]++] = corner;
    // The only half-edge of a leaf that leads to `to`; itself stays out of question.
    const auto find = [&](NodeId from, NodeId to, CornerId self) {
        for (uint32_t i = begin[from]; i < begin[from + 1]; ++i) {
            if (leaving[i] != self && head(leaving[i]) == to) return leaving[i];
        }
        return kNoCorner;
    };
    mate_.resize(node_.size());
    for (CornerId corner = 0; corner < node_.size(); ++corner) {
        CHECK(find(node_[corner], head(corner), corner) == kNoCorner);
        mate_[corner] = find(head(corner), node_[corner], corner);
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
