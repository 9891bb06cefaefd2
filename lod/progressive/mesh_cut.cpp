#include "lod/progressive/mesh_cut.h"

#include <algorithm>

#include "lod/base/check.h"
#include "lod/base/hash.h"

namespace lod {

MeshCut::MeshCut(const ProgressiveMesh& mesh)
    : mesh_(&mesh), triangle_flags_(mesh.triangle_count(), 0), is_active_(mesh.hierarchy.node_count(), 0) {
    corners_.reserve(3 * size_t{mesh.triangle_count()});
    vertices_.reserve(3 * size_t{mesh.triangle_count()});
    touched_.reserve(mesh.triangle_count());
    for (uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
        corners_.insert(corners_.end(), mesh.last_corners[triangle].begin(),
                        mesh.last_corners[triangle].end());
        vertices_.insert(vertices_.end(), mesh.last_vertices[triangle].begin(),
                         mesh.last_vertices[triangle].end());
        if (mesh.remover[triangle] != kNoNode) continue;
        triangle_flags_[triangle] = kDrawn;
        touch(triangle);
        ++drawn_count_;
    }
    for (NodeId root : mesh.roots)
        is_active_[root] = 1;
}

NodeId MeshCut::largest_neighbour(NodeId node) const {
    NodeId largest = 0;
    for (CornerId corner : mesh_->star(node)) {
        if (!is_drawn(corner / 3)) continue;
        largest = std::max({largest, corners_[next_corner(corner)], corners_[previous_corner(corner)]});
    }
    return largest;
}

NodeId MeshCut::oldest_parent(NodeId node) const {
    const std::vector<NodeId>& parent = mesh_->hierarchy.parent;
    NodeId oldest = kNoNode;
    for (CornerId corner : mesh_->star(node)) {
        if (!is_drawn(corner / 3)) continue;
        oldest = std::min(
            {oldest, parent[corners_[next_corner(corner)]], parent[corners_[previous_corner(corner)]]});
    }
    return oldest;
}

NodeId MeshCut::split_blocker(NodeId node) const {
    NodeId largest = node;
    for (CornerId corner : mesh_->star(node)) {
        if (is_drawn(corner / 3)) {
            largest = std::max({largest, corners_[next_corner(corner)], corners_[previous_corner(corner)]});
            continue;
        }
        NodeId remover = mesh_->remover[corner / 3];
        while (!is_active(remover))
            remover = mesh_->hierarchy.parent[remover];
        largest = std::max(largest, remover);
    }
    return largest == node ? kNoNode : largest;
}

NodeId MeshCut::collapse_blocker(NodeId node) const {
    const auto& children = mesh_->hierarchy.children[mesh_->collapse_of(node)];
    const NodeId oldest = std::min(oldest_parent(children[0]), oldest_parent(children[1]));
    return oldest < node ? oldest : kNoNode;
}

void MeshCut::vsplit(NodeId node) {
    DCHECK(is_active(node) && split_blocker(node) == kNoNode);
    const uint32_t collapse = mesh_->collapse_of(node);
    const auto& children = mesh_->hierarchy.children[collapse];
    for (uint32_t child = 0; child < 2; ++child) {
        const std::span<const CornerId> kept = mesh_->kept(collapse, child);
        const std::span<const std::array<VertexId, 2>> shown = mesh_->kept_vertices(collapse, child);
        for (size_t i = 0; i < kept.size(); ++i) {
            corners_[kept[i]] = children[child];
            vertices_[kept[i]] = shown[i][0];
            touch(kept[i] / 3);
        }
        is_active_[children[child]] = 1;
    }
    const std::span<const uint32_t> removed = mesh_->removed(collapse);
    for (uint32_t triangle : removed) {
        triangle_flags_[triangle] |= kDrawn;
        touch(triangle);
    }
    is_active_[node] = 0;
    drawn_count_ += static_cast<uint32_t>(removed.size());
    hash_ ^= mix64(node);
}

void MeshCut::ecol(NodeId node) {
    DCHECK(are_children_active(node) && collapse_blocker(node) == kNoNode);
    const uint32_t collapse = mesh_->collapse_of(node);
    const VertexHierarchy& h = mesh_->hierarchy;
    for (uint32_t i = h.kept_begin[2 * collapse]; i < h.kept_begin[2 * collapse + 2]; ++i) {
        corners_[h.kept[i]] = node;
        vertices_[h.kept[i]] = h.kept_vertex[i][1];
        touch(h.kept[i] / 3);
    }
    const std::span<const uint32_t> removed = mesh_->removed(collapse);
    for (uint32_t triangle : removed) {
        triangle_flags_[triangle] = static_cast<uint8_t>(triangle_flags_[triangle] & ~kDrawn);
        touch(triangle);
    }
    for (NodeId child : h.children[collapse])
        is_active_[child] = 0;
    is_active_[node] = 1;
    drawn_count_ -= static_cast<uint32_t>(removed.size());
    hash_ ^= mix64(node);
}

void MeshCut::forget_touched() {
    for (uint32_t triangle : touched_)
        triangle_flags_[triangle] = static_cast<uint8_t>(triangle_flags_[triangle] & ~kTouched);
    touched_.clear();
}

std::string MeshCut::validate() const {
    const VertexHierarchy& h = mesh_->hierarchy;
    std::vector<NodeId> standing(h.leaf_count);  // for each leaf its active ancestor
    for (NodeId leaf = 0; leaf < h.leaf_count; ++leaf) {
        uint32_t found = 0;
        for (NodeId node = leaf; node != kNoNode; node = h.parent[node]) {
            if (!is_active(node)) continue;
            standing[leaf] = node;
            ++found;
        }
        if (found != 1) return "vertex " + std::to_string(leaf) + " has not one active ancestor";
    }
    uint32_t drawn = 0;
    for (uint32_t t = 0; t < mesh_->triangle_count(); ++t) {
        const NodeId a = standing[h.triangles[t][0]], b = standing[h.triangles[t][1]],
                     c = standing[h.triangles[t][2]];
        const bool has_area = a != b && b != c && c != a;
        const std::string name = "triangle " + std::to_string(t);
        if (is_drawn(t) != has_area) return name + (has_area ? " is lost" : " should be gone");
        if (!has_area) continue;
        ++drawn;
        const auto at = corners(t);
        if (at[0] != a || at[1] != b || at[2] != c) return name + " has a wrong corner";
        for (size_t i = 0; i < 3; ++i) {
            if (h.vertex_node[vertices(t)[i]] != at[i]) return name + " shows a vertex of another node";
        }
        const NodeId youngest = std::max({a, b, c});
        if (std::min({h.parent[a], h.parent[b], h.parent[c]}) <= youngest)
            return name + " joins nodes that the build never saw together";
    }
    return drawn == drawn_count_ ? "" : "the triangles are miscounted";
}

}  // namespace lod
