#include "lod/progressive/hierarchy_check.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace lod {
namespace {

bool rises_to(const std::vector<uint32_t>& begins, size_t count, size_t end) {
    return begins.size() == count && !begins.empty() && begins.front() == 0 && begins.back() == end &&
           std::is_sorted(begins.begin(), begins.end());
}

bool are_sizes_right(const VertexHierarchy& h) {
    const size_t nodes = h.position.size(), vertices = h.vertex_node.size();
    if (nodes < h.leaf_count || nodes >= kNoNode || vertices < nodes || vertices >= kNoNode) return false;
    const size_t collapses = nodes - h.leaf_count;
    return h.parent.size() == nodes && h.children.size() == collapses && h.error_m.size() == nodes &&
           h.centre.size() == nodes && h.radius_m.size() == nodes && h.cone_axis.size() == nodes &&
           h.cone_cos.size() == nodes && h.normal.size() == vertices && h.colour.size() == vertices &&
           h.triangle_vertices.size() == h.triangles.size() && h.kept_vertex.size() == h.kept.size() &&
           rises_to(h.removed_begin, collapses + 1, h.removed.size()) &&
           rises_to(h.kept_begin, 2 * collapses + 1, h.kept.size());
}

bool are_numbers_right(const VertexHierarchy& h) {
    const auto is_finite = [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    for (size_t i = 0; i < h.position.size(); ++i) {
        if (!is_finite(h.position[i]) || !is_finite(h.centre[i]) || !is_finite(h.cone_axis[i])) return false;
        if (!std::isfinite(h.error_m[i]) || h.error_m[i] < 0.0f) return false;
        if (!std::isfinite(h.radius_m[i]) || h.radius_m[i] < 0.0f || !std::isfinite(h.cone_cos[i]))
            return false;
    }
    return std::all_of(h.normal.begin(), h.normal.end(), is_finite);
}

/// Parents are younger than their children, which name them; errors rise.
bool are_kin_right(const VertexHierarchy& h) {
    std::vector<uint8_t> has_parent(h.position.size(), 0);
    for (size_t k = 0; k < h.children.size(); ++k) {
        const auto node = static_cast<NodeId>(h.leaf_count + k);
        for (NodeId child : h.children[k]) {
            if (child >= node || h.parent[child] != node || has_parent[child]) return false;
            if (h.error_m[child] > h.error_m[node]) return false;
            has_parent[child] = 1;
        }
    }
    for (size_t node = 0; node < h.position.size(); ++node) {
        if ((h.parent[node] != kNoNode) != (has_parent[node] != 0)) return false;
        if (h.vertex_node[node] != node) return false;
    }
    return std::all_of(h.vertex_node.begin(), h.vertex_node.end(),
                       [&h](NodeId node) { return node < h.position.size(); });
}

/// The corners of the full mesh, replayed through all collapses.
class Replay {
  public:
    explicit Replay(const VertexHierarchy& h) : h_(h), is_removed_(h.triangles.size(), 0) {}

    bool begin() {
        for (size_t t = 0; t < h_.triangles.size(); ++t) {
            for (size_t k = 0; k < 3; ++k) {
                const VertexId vertex = h_.triangle_vertices[t][k];
                if (h_.triangles[t][k] >= h_.leaf_count || vertex >= h_.vertex_node.size()) return false;
                if (h_.vertex_node[vertex] != h_.triangles[t][k]) return false;
                shown_.push_back(vertex);
            }
        }
        return true;
    }

    bool collapse(uint32_t k) {
        const NodeId node = h_.leaf_count + k;
        for (uint32_t i = h_.removed_begin[k]; i < h_.removed_begin[k + 1]; ++i) {
            const uint32_t triangle = h_.removed[i];
            if (triangle >= is_removed_.size() || is_removed_[triangle]) return false;
            is_removed_[triangle] = 1;
            if (!holds(triangle, h_.children[k][0]) || !holds(triangle, h_.children[k][1])) return false;
        }
        for (uint32_t side = 0; side < 2; ++side) {
            for (uint32_t i = h_.kept_begin[2 * k + side]; i < h_.kept_begin[2 * k + side + 1]; ++i) {
                const auto [before, after] = h_.kept_vertex[i];
                const CornerId corner = h_.kept[i];
                if (corner >= shown_.size() || is_removed_[corner / 3] || shown_[corner] != before)
                    return false;
                if (after >= h_.vertex_node.size() || h_.vertex_node[before] != h_.children[k][side])
                    return false;
                if (h_.vertex_node[after] != node) return false;
                shown_[corner] = after;
            }
        }
        return true;
    }

  private:
    bool holds(uint32_t triangle, NodeId node) const {
        const auto shows = [&](VertexId vertex) { return h_.vertex_node[vertex] == node; };
        return std::any_of(&shown_[3 * triangle], &shown_[3 * triangle] + 3, shows);
    }

    const VertexHierarchy& h_;
    std::vector<VertexId> shown_;
    std::vector<uint8_t> is_removed_;
};

}  // namespace

std::string fault_of(const VertexHierarchy& h) {
    if (!are_sizes_right(h)) return "arrays of different lengths; expected those of one hierarchy";
    if (!are_numbers_right(h)) return "a number that is none or below 0; expected finite ones";
    if (!are_kin_right(h)) return "nodes that are not one another's kin; expected parents after children";
    Replay replay(h);
    if (!replay.begin()) return "a triangle with corners that are no leaves; expected leaves";
    for (uint32_t k = 0; k < h.collapse_count(); ++k) {
        if (!replay.collapse(k))
            return "collapse " + std::to_string(k) +
                   " that does not fit the mesh; expected corners of its nodes";
    }
    return "";
}

}  // namespace lod
