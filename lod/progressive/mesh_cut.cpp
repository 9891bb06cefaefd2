#include "lod/progressive/mesh_cut.h"

#include <algorithm>
#include <bit>

#include "lod/base/check.h"
#include "lod/base/float4.h"
#include "lod/base/hash.h"

namespace lod {

MeshCut::MeshCut(const ProgressiveMesh& mesh)
    : mesh_(&mesh), triangles_(mesh.triangle_count()), is_active_(mesh.hierarchy.node_count(), 0) {
    CHECK(mesh.hierarchy.node_count() < kNoParent);
    touched_.reserve(mesh.triangle_count());
    for (uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
        std::copy_n(mesh.last_corners[triangle].begin(), 3, triangles_[triangle].corners.begin());
        triangles_[triangle].vertices = mesh.last_vertices[triangle];
        auto& [corners, parents, vertices, is_touched] = triangles_[triangle];
        parents = {parent_of(corners[0]), parent_of(corners[1]), parent_of(corners[2]), kNoParent};
        corners[3] = mesh.remover[triangle] != kNoNode ? 1 : 0;
        if (corners[3] == 0) touch(triangle);
    }
    drawn_count_ = static_cast<uint32_t>(touched_.size());
    for (NodeId root : mesh.roots)
        is_active_[root] = 1;
}

NodeId MeshCut::split_blocker(NodeId node) const {
    Int4 largest = Int4{} + static_cast<int32_t>(node);
    largest[3] = 0;
    for (CornerId corner : mesh_->star(node)) {
        const Int4 corners = std::bit_cast<Int4>(triangles_[corner / 3].corners);
        largest = corners > largest ? corners : largest;
    }
    if (largest[3] != 0) return split_blocker_of_torn(node);
    const auto youngest = static_cast<NodeId>(std::max({largest[0], largest[1], largest[2]}));
    return youngest == node ? kNoNode : youngest;
}

/// Where triangles of the star have been collapsed: whoever took them away counts for them.
NodeId MeshCut::split_blocker_of_torn(NodeId node) const {
    NodeId youngest = node;
    for (CornerId corner : mesh_->star(node)) {
        const uint32_t triangle = corner / 3;
        if (is_drawn(triangle)) {
            const Four& corners = triangles_[triangle].corners;
            youngest = std::max({youngest, corners[0], corners[1], corners[2]});
            continue;
        }
        NodeId remover = mesh_->remover[triangle];
        while (!is_active(remover))
            remover = mesh_->hierarchy.parent[remover];
        youngest = std::max(youngest, remover);
    }
    return youngest == node ? kNoNode : youngest;
}

/// The triangles that the build saw around the collapse are enough to ask. If none of their corners has an older parent,
/// all of them are as they were then, and no other triangle can be in the star.
NodeId MeshCut::collapse_blocker(NodeId node) const {
    Int4 oldest = Int4{} + static_cast<int32_t>(node);  // the parent of both children themselves
    const uint32_t collapse = mesh_->collapse_of(node);
    const auto take = [&](uint32_t triangle) {
        const Int4 parents = std::bit_cast<Int4>(triangles_[triangle].parents);
        oldest = parents < oldest ? parents : oldest;
    };
    for (CornerId corner : mesh_->star(node))
        take(corner / 3);
    for (uint32_t triangle : mesh_->removed(collapse))
        take(triangle);
    const auto first = static_cast<NodeId>(std::min({oldest[0], oldest[1], oldest[2]}));
    return first == node ? kNoNode : first;
}

void MeshCut::expect_vsplit(NodeId node) const {
    for (CornerId corner : mesh_->star(node))
        __builtin_prefetch(&triangles_[corner / 3], 1);
    for (NodeId child : mesh_->heads[mesh_->collapse_of(node)].children) {
        if (!mesh_->is_leaf(child)) __builtin_prefetch(&mesh_->bounds[mesh_->collapse_of(child)]);
        __builtin_prefetch(&mesh_->hierarchy.position[child]);
    }
}

void MeshCut::expect_ecol(NodeId node) const {
    for (CornerId corner : mesh_->star(node))
        __builtin_prefetch(&triangles_[corner / 3], 1);
    for (uint32_t triangle : mesh_->removed(mesh_->collapse_of(node)))
        __builtin_prefetch(&triangles_[triangle], 1);
}

void MeshCut::vsplit(NodeId node) {
    DCHECK(is_active(node) && split_blocker(node) == kNoNode);
    const uint32_t collapse = mesh_->collapse_of(node);
    const CollapseHead& head = mesh_->heads[collapse];
    const VertexId* shown = mesh_->kept_vertices(collapse);
    for (uint32_t child = 0; child < 2; ++child) {
        for (CornerId corner : mesh_->kept(collapse, child)) {
            show(corner, head.children[child], node, shown[0]);
            shown += 2;
        }
        is_active_[head.children[child]] = 1;
    }
    for (uint32_t triangle : mesh_->removed(collapse)) {
        triangles_[triangle].corners[3] = 0;
        touch(triangle);
    }
    is_active_[node] = 0;
    drawn_count_ += head.removed_count;
    hash_ ^= mix64(node);
}

void MeshCut::ecol(NodeId node) {
    DCHECK(are_children_active(node) && collapse_blocker(node) == kNoNode);
    const uint32_t collapse = mesh_->collapse_of(node);
    const CollapseHead& head = mesh_->heads[collapse];
    const NodeId parent = std::min(head.parent, kNoParent);
    const VertexId* shown = mesh_->kept_vertices(collapse);
    for (CornerId corner : mesh_->star(node)) {
        show(corner, node, parent, shown[1]);
        shown += 2;
    }
    for (uint32_t triangle : mesh_->removed(collapse)) {
        triangles_[triangle].corners[3] = 1;
        touch(triangle);
    }
    for (NodeId child : head.children)
        is_active_[child] = 0;
    is_active_[node] = 1;
    drawn_count_ -= head.removed_count;
    hash_ ^= mix64(node);
}

void MeshCut::forget_touched() {
    for (uint32_t triangle : touched_)
        triangles_[triangle].is_touched = 0;
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
        for (size_t k = 0; k < 3; ++k) {
            if (triangles_[t].parents[k] != parent_of(at[k])) return name + " has a wrong parent";
        }
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
