// SurfaceImage at the start: the full mesh on itself, with nothing on an edge or a node.
//
// Every vertex is moved a little into one of the triangles around it, its home: sector 0 of its fan. An edge goes along
// its left triangle; at its ends it turns round the vertices' nodes to reach it, the shorter way. Between two
// neighbouring edges that turn different ways lies the triangle that owns the node.

#include "lod/base/check.h"
#include "lod/progressive/surface_image.h"

namespace lod {
namespace {

/// The turn from home to a sector: counter-clockwise positive. At borders there is only one way.
int turn_to(int sector, int count, bool is_closed) {
    return !is_closed || 2 * sector <= count ? sector : sector - count;
}

size_t sector_of(const Fan& fan, CornerId corner) {
    for (size_t i = 0; i < fan.corners.size(); ++i) {
        if (fan.corners[i] == corner) return i;
    }
    CHECK(false);
}

}  // namespace

SurfaceImage::SurfaceImage(std::span<const glm::vec3> leaves,
                           std::span<const std::array<NodeId, 3>> triangles)
    : triangles_(triangles),
      leaf_count_(static_cast<uint32_t>(leaves.size())),
      positions_(leaves.begin(), leaves.end()),
      mesh_(triangles, leaf_count_) {
    const size_t corners = mesh_.corner_count();
    const size_t most_nodes = 2 * leaves.size();  // a collapse makes one of two
    positions_.reserve(most_nodes);
    edge_of_.resize(corners);
    on_.resize(triangles_.size());
    triangle_of_.resize(leaf_count_);
    border_of_.resize(leaf_count_, kNoCorner);
    crossers_.resize(corners);
    passers_.resize(most_nodes);
    owner_.resize(most_nodes, kNone);
    owned_.resize(triangles_.size());
    corner_of_.resize(most_nodes, kNoCorner);
    owner_m_.resize(most_nodes, 0.0);
    seen_m_.resize(most_nodes, 0.0);
    member_of_.resize(leaf_count_, kNone);
    sector_of_.resize(triangles_.size(), kNone);
    rule_of_.resize(corners, kNone);
    noise_m_ = noise_m(leaves);
    begin_edges();
    is_touched_.resize(edges_.size(), 0);
    begin_vertices();
    for (uint32_t e = 0; e < edges_.size(); ++e) {
        for (CornerId letter : edges_[e].word)
            crossers_[canonical(letter)].push_back(e);
    }
}

void SurfaceImage::begin_edges() {
    for (CornerId corner = 0; corner < mesh_.corner_count(); ++corner) {
        corner_of_[mesh_.node(corner)] = corner;
        const CornerId mate = mesh_.mate(corner);
        if (mate < corner) continue;
        const auto edge = static_cast<uint32_t>(edges_.size());
        edges_.push_back({mesh_.node(corner), mesh_.head(corner), corner, mate, {}});
        edge_of_[corner] = edge;
        if (mate == kNoCorner) {
            passes_[edge].push_back({mesh_.head(corner), true});
            passers_[mesh_.head(corner)].push_back(edge);
        } else {
            edge_of_[mate] = edge;
        }
    }
    incident_begin_.assign(leaf_count_ + 1, 0);
    for (const FullEdge& edge : edges_)
        ++incident_begin_[edge.u + 1], ++incident_begin_[edge.v + 1];
    for (size_t i = 1; i < incident_begin_.size(); ++i)
        incident_begin_[i] += incident_begin_[i - 1];
    incident_.resize(2 * edges_.size());
    std::vector<uint32_t> next(incident_begin_.begin(), incident_begin_.end() - 1);
    for (uint32_t e = 0; e < edges_.size(); ++e) {
        incident_[next[edges_[e].u]++] = e;
        incident_[next[edges_[e].v]++] = e;
    }
}

/// Homes, owners, and the turns of words: those at their beginnings first, then those at their ends.
void SurfaceImage::begin_vertices() {
    Fan fan;
    for (const bool is_tail : {true, false}) {
        for (uint32_t leaf = 0; leaf < leaf_count_; ++leaf) {
            mesh_.fan_at(corner_of_[leaf], fan);
            const auto count = static_cast<int>(fan.corners.size());
            for (uint32_t i = incident_begin_[leaf]; i < incident_begin_[leaf + 1]; ++i) {
                FullEdge& edge = edges_[incident_[i]];
                if ((edge.u == leaf) != is_tail) continue;
                const size_t sector = sector_of(fan, is_tail ? edge.left : next_corner(edge.left));
                const bool is_ccw = turn_to(static_cast<int>(sector), count, fan.is_closed) >= 0;
                const auto add = [&](CornerId letter) { append_reduced(mesh_, leaf, letter, edge.word); };
                if (is_tail)
                    walk_fan(fan, 0, sector, is_ccw, add);
                else
                    walk_fan(fan, sector, 0, !is_ccw, add);
            }
            if (is_tail) begin_owner(fan, leaf);
        }
    }
}

void SurfaceImage::begin_owner(const Fan& fan, NodeId leaf) {
    const CornerId home = fan.corners[0];
    triangle_of_[leaf] = home / 3;
    on_[home / 3].push_back(leaf);
    if (!fan.is_closed) {
        border_of_[leaf] = home;
        return;
    }
    const auto count = static_cast<int>(fan.corners.size());
    const auto left_sector = [&](int spoke) {  // of the edge there, counted on beyond the first round
        const CornerId corner = fan.corners[static_cast<size_t>(spoke % count)];
        return edges_[edge_of_[corner]].left == corner ? spoke : spoke - 1;
    };
    for (int spoke = 0; spoke < count; ++spoke) {
        const int from = left_sector(spoke), to = left_sector(spoke + 1);
        const int turn = turn_to(to % count, count, true) - turn_to((from + count) % count, count, true);
        if (turn == to - from) continue;
        CHECK(owner_[leaf] == kNone && to - from - turn == count);
        owner_[leaf] = fan.corners[static_cast<size_t>(spoke)] / 3;
        owned_[owner_[leaf]].push_back(leaf);
    }
    CHECK(owner_[leaf] != kNone);
}

}  // namespace lod
