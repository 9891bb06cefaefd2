#include "lod/progressive/hierarchy_recorder.h"

#include <algorithm>
#include <cmath>

#include "lod/base/check.h"

namespace lod {
namespace {

constexpr VertexId kFurther = 0x80000000u;

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& other) {
    const float length = glm::length(v);
    return length > 1e-6f ? v / length : other;
}

/// Means over some vertices.
struct Look {
    glm::vec3 normal{0.0f};
    glm::vec3 colour{0.0f};
    int count = 0;
};

}  // namespace

HierarchyRecorder::HierarchyRecorder(const ManifoldMesh& mesh) {
    const auto leaves = static_cast<uint32_t>(mesh.positions.size());
    out_.leaf_count = leaves;
    out_.position = mesh.positions;
    out_.parent.assign(leaves, kNoNode);
    out_.triangles = mesh.triangles;
    const auto own = static_cast<std::ptrdiff_t>(leaves);
    out_.vertex_node.assign(mesh.vertex_leaf.begin(), mesh.vertex_leaf.begin() + own);
    out_.normal.assign(mesh.normals.begin(), mesh.normals.begin() + own);
    out_.colour.assign(mesh.colours.begin(), mesh.colours.begin() + own);
    further_node_.assign(mesh.vertex_leaf.begin() + own, mesh.vertex_leaf.end());
    further_normal_.assign(mesh.normals.begin() + own, mesh.normals.end());
    further_colour_.assign(mesh.colours.begin() + own, mesh.colours.end());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const VertexId vertex = mesh.triangle_corners[t][k];
            corner_node_.push_back(mesh.triangles[t][k]);
            corner_vertex_.push_back(vertex < leaves ? vertex : kFurther + (vertex - leaves));
        }
    }
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        out_.triangle_vertices.push_back(
            {corner_vertex_[3 * t], corner_vertex_[3 * t + 1], corner_vertex_[3 * t + 2]});
    out_.removed_begin.push_back(0);
    out_.kept_begin.push_back(0);
}

/// Sorts the triangles around `node` into removed (once) and kept.
void HierarchyRecorder::record_corners(NodeId node, std::span<const uint32_t> triangles, bool is_first) {
    const NodeId other = out_.children.back()[is_first ? 1 : 0];
    for (uint32_t triangle : triangles) {
        CornerId corner = 3 * triangle;
        const NodeId* nodes = &corner_node_[corner];
        if (std::find(nodes, nodes + 3, other) != nodes + 3) {
            if (is_first) out_.removed.push_back(triangle);
            continue;
        }
        while (corner_node_[corner] != node)
            ++corner;
        out_.kept.push_back(corner);
        out_.kept_vertex.push_back({corner_vertex_[corner], corner_vertex_[corner]});
    }
    out_.kept_begin.push_back(static_cast<uint32_t>(out_.kept.size()));
}

size_t HierarchyRecorder::group_of(VertexId vertex) {
    for (size_t i = 0; i < groups_.size(); ++i) {
        if (std::find(groups_[i].begin(), groups_[i].end(), vertex) != groups_[i].end()) return i;
    }
    groups_.push_back({vertex});
    return groups_.size() - 1;
}

/// Puts the vertices of a and b that meet in a removed triangle into one group.
void HierarchyRecorder::join_removed(const EdgeCollapse& collapse) {
    groups_.clear();
    for (uint32_t i = out_.removed_begin.back(); i < out_.removed.size(); ++i) {
        std::array<VertexId, 2> ends{};
        for (CornerId corner = 3 * out_.removed[i]; corner < 3 * out_.removed[i] + 3; ++corner) {
            if (corner_node_[corner] == collapse.a) ends[0] = corner_vertex_[corner];
            if (corner_node_[corner] == collapse.b) ends[1] = corner_vertex_[corner];
        }
        const size_t a = group_of(ends[0]), b = group_of(ends[1]);
        if (a == b) continue;
        groups_[a].insert(groups_[a].end(), groups_[b].begin(), groups_[b].end());
        groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(b));
    }
}

/// The vertex that a group becomes; the first is the node's own.
VertexId HierarchyRecorder::mix(std::span<const VertexId> group, NodeId node, const EdgeCollapse& collapse) {
    Look looks[2];
    for (VertexId vertex : group) {
        const bool is_own = vertex < kFurther;
        const NodeId of = is_own ? vertex : further_node_[vertex - kFurther];
        const glm::vec3& normal = is_own ? out_.normal[vertex] : further_normal_[vertex - kFurther];
        const glm::u8vec4& colour = is_own ? out_.colour[vertex] : further_colour_[vertex - kFurther];
        Look& look = looks[of == collapse.a ? 0 : 1];
        look.normal += normal;
        look.colour += glm::vec3(colour);
        ++look.count;
    }
    for (Look& look : looks) {
        if (look.count == 0) continue;
        look.normal = unit_or(look.normal, look.normal);
        look.colour /= static_cast<float>(look.count);
    }
    const float share = looks[0].count == 0 ? 1.0f : looks[1].count == 0 ? 0.0f : collapse.share;
    const VertexId head = group.front();
    const glm::vec3& head_normal = head < kFurther ? out_.normal[head] : further_normal_[head - kFurther];
    const uint8_t material = head < kFurther ? out_.colour[head].w : further_colour_[head - kFurther].w;
    const glm::vec3 normal = unit_or(looks[0].normal * (1.0f - share) + looks[1].normal * share, head_normal);
    const glm::vec3 blend = looks[0].colour * (1.0f - share) + looks[1].colour * share + 0.5f;
    const glm::u8vec4 colour(static_cast<uint8_t>(blend.x), static_cast<uint8_t>(blend.y),
                             static_cast<uint8_t>(blend.z), material);
    if (out_.vertex_node.size() == node) {
        out_.vertex_node.push_back(node);
        out_.normal.push_back(normal);
        out_.colour.push_back(colour);
        return node;
    }
    further_node_.push_back(node);
    further_normal_.push_back(normal);
    further_colour_.push_back(colour);
    return kFurther + static_cast<VertexId>(further_node_.size() - 1);
}

/// Gives every kept corner the vertex it shows after the collapse.
void HierarchyRecorder::show_vertices(NodeId node, const EdgeCollapse& collapse) {
    const uint32_t begin = out_.kept_begin[out_.kept_begin.size() - 3];
    for (uint32_t i = begin; i < out_.kept.size(); ++i)
        group_of(out_.kept_vertex[i][0]);
    std::vector<VertexId> after;
    after.reserve(groups_.size());
    for (const std::vector<VertexId>& group : groups_)
        after.push_back(mix(group, node, collapse));
    for (uint32_t i = begin; i < out_.kept.size(); ++i) {
        const CornerId corner = out_.kept[i];
        out_.kept_vertex[i][1] = after[group_of(out_.kept_vertex[i][0])];
        corner_node_[corner] = node;
        corner_vertex_[corner] = out_.kept_vertex[i][1];
    }
}

NodeId HierarchyRecorder::record(const EdgeCollapse& collapse) {
    const NodeId node = out_.node_count();
    out_.children.push_back({collapse.a, collapse.b});
    out_.parent[collapse.a] = out_.parent[collapse.b] = node;
    out_.parent.push_back(kNoNode);
    out_.position.push_back(collapse.position);
    record_corners(collapse.a, collapse.a_triangles, true);
    record_corners(collapse.b, collapse.b_triangles, false);
    join_removed(collapse);
    show_vertices(node, collapse);
    out_.removed_begin.push_back(static_cast<uint32_t>(out_.removed.size()));
    return node;
}

VertexHierarchy HierarchyRecorder::finish() {
    const uint32_t nodes = out_.node_count();
    CHECK(out_.vertex_node.size() == nodes);
    const auto settle = [nodes](VertexId& vertex) {
        if (vertex >= kFurther) vertex = nodes + (vertex - kFurther);
    };
    for (auto& vertices : out_.triangle_vertices)
        for (VertexId& vertex : vertices)
            settle(vertex);
    for (auto& pair : out_.kept_vertex)
        for (VertexId& vertex : pair)
            settle(vertex);
    out_.vertex_node.insert(out_.vertex_node.end(), further_node_.begin(), further_node_.end());
    out_.normal.insert(out_.normal.end(), further_normal_.begin(), further_normal_.end());
    out_.colour.insert(out_.colour.end(), further_colour_.begin(), further_colour_.end());
    return std::move(out_);
}

}  // namespace lod
