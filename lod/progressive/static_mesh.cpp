#include "lod/progressive/static_mesh.h"

#include <algorithm>

namespace lod {
namespace {

/// Collapses in the order of the build, as far as they are wanted and legal.
class Coarsening {
  public:
    explicit Coarsening(const VertexHierarchy& h)
        : h_(h),
          left_(h.triangles.size()),
          is_removed_(h.triangles.size(), 0),
          is_done_(h.collapse_count(), 0) {
        for (const auto& vertices : h.triangle_vertices)
            shown_.insert(shown_.end(), vertices.begin(), vertices.end());
    }

    uint64_t triangles() const { return left_; }

    /// Does every collapse within the tolerance that was not done yet, until no more than `enough` triangles are left.
    /// @param may_overshoot  also when fewer would be left
    void run(double tolerance_m, uint64_t enough, bool may_overshoot) {
        for (uint32_t k = 0; k < h_.collapse_count() && left_ > enough; ++k) {
            const uint64_t removed = h_.removed_begin[k + 1] - h_.removed_begin[k];
            if (!may_overshoot && left_ < enough + removed) continue;
            if (!is_done_[k] && double(h_.error_m[h_.leaf_count + k]) <= tolerance_m && is_legal(k))
                collapse(k);
        }
    }

    /// Undoes the youngest collapse that was done, may be undone first, and brings no more than `room` triangles.
    /// @returns  how many it brought; 0: there is none
    uint64_t give_back(uint64_t room) {
        for (uint32_t k = h_.collapse_count(); k-- > 0;) {
            const uint64_t removed = h_.removed_begin[k + 1] - h_.removed_begin[k];
            if (!is_done_[k] || removed > room || !is_split_legal(k)) continue;
            split(k);
            return removed;
        }
        return 0;
    }

    StaticMesh mesh() const {
        StaticMesh out;
        for (size_t t = 0; t < is_removed_.size(); ++t) {
            if (is_removed_[t]) continue;
            out.triangles.push_back({shown_[3 * t], shown_[3 * t + 1], shown_[3 * t + 2]});
            out.full_triangle.push_back(static_cast<uint32_t>(t));
            for (VertexId vertex : out.triangles.back())
                out.error_m = std::max(out.error_m, double(h_.error_m[h_.vertex_node[vertex]]));
        }
        return out;
    }

  private:
    bool is_active(NodeId node) const { return node < h_.leaf_count || is_done_[node - h_.leaf_count]; }

    /// id(p) < the parents of all neighbours, as vertex_hierarchy.h has it.
    bool is_legal(uint32_t k) const {
        const NodeId node = h_.leaf_count + k;
        if (!is_active(h_.children[k][0]) || !is_active(h_.children[k][1])) return false;
        const auto are_corners_old = [&](uint32_t triangle) {
            return std::all_of(&shown_[3 * triangle], &shown_[3 * triangle] + 3,
                               [&](VertexId vertex) { return h_.parent[h_.vertex_node[vertex]] >= node; });
        };
        for (uint32_t i = h_.removed_begin[k]; i < h_.removed_begin[k + 1]; ++i)
            if (!are_corners_old(h_.removed[i])) return false;
        for (uint32_t i = h_.kept_begin[2 * k]; i < h_.kept_begin[2 * k + 2]; ++i)
            if (!are_corners_old(h_.kept[i] / 3)) return false;
        return true;
    }

    bool is_gone(NodeId node) const { return h_.parent[node] != kNoNode && is_active(h_.parent[node]); }

    /// id(p) > all neighbours; stricter where a triangle of the star is gone or leads to a node that is.
    bool is_split_legal(uint32_t k) const {
        const NodeId node = h_.leaf_count + k;
        if (is_gone(node)) return false;
        for (uint32_t i = h_.kept_begin[2 * k]; i < h_.kept_begin[2 * k + 2]; ++i) {
            const VertexId* shown = &shown_[h_.kept[i] / 3 * 3];
            const bool is_young =
                std::any_of(shown, shown + 3, [&](VertexId vertex) { return h_.vertex_node[vertex] > node; });
            if (is_removed_[h_.kept[i] / 3] || is_young) return false;
        }
        for (uint32_t i = h_.removed_begin[k]; i < h_.removed_begin[k + 1]; ++i) {
            for (CornerId corner = 3 * h_.removed[i]; corner < 3 * h_.removed[i] + 3; ++corner) {
                const NodeId at = h_.vertex_node[shown_[corner]];
                if (h_.parent[at] != node && is_gone(at)) return false;
            }
        }
        return true;
    }

    void split(uint32_t k) {
        is_done_[k] = 0;
        for (uint32_t i = h_.removed_begin[k]; i < h_.removed_begin[k + 1]; ++i)
            is_removed_[h_.removed[i]] = 0;
        left_ += h_.removed_begin[k + 1] - h_.removed_begin[k];
        for (uint32_t i = h_.kept_begin[2 * k]; i < h_.kept_begin[2 * k + 2]; ++i)
            shown_[h_.kept[i]] = h_.kept_vertex[i][0];
    }

    void collapse(uint32_t k) {
        is_done_[k] = 1;
        for (uint32_t i = h_.removed_begin[k]; i < h_.removed_begin[k + 1]; ++i)
            is_removed_[h_.removed[i]] = 1;
        left_ -= h_.removed_begin[k + 1] - h_.removed_begin[k];
        for (uint32_t i = h_.kept_begin[2 * k]; i < h_.kept_begin[2 * k + 2]; ++i)
            shown_[h_.kept[i]] = h_.kept_vertex[i][1];
    }

    const VertexHierarchy& h_;
    uint64_t left_;
    std::vector<VertexId> shown_;  // [corners]
    std::vector<uint8_t> is_removed_;
    std::vector<uint8_t> is_done_;
};

uint64_t triangles_at(std::span<const ScaledHierarchy> hierarchies, double tolerance_m) {
    uint64_t sum = 0;
    for (const auto& [hierarchy, scale] : hierarchies) {
        Coarsening coarsening(*hierarchy);
        coarsening.run(tolerance_m / scale, 0, true);
        sum += coarsening.triangles();
    }
    return sum;
}

/// All errors that occur, each once, ascending.
std::vector<double> errors_of(std::span<const ScaledHierarchy> hierarchies) {
    std::vector<double> errors{0.0};
    for (const auto& [hierarchy, scale] : hierarchies) {
        for (float error_m : hierarchy->error_m)
            errors.push_back(double(error_m) * scale *
                             (1.0 + 1e-12));  // its quotient by the scale is no less
    }
    std::sort(errors.begin(), errors.end());
    errors.erase(std::unique(errors.begin(), errors.end()), errors.end());
    return errors;
}

}  // namespace

StaticMesh mesh_at_tolerance(const VertexHierarchy& hierarchy, double tolerance_m) {
    Coarsening coarsening(hierarchy);
    coarsening.run(tolerance_m, 0, true);
    return coarsening.mesh();
}

std::vector<StaticMesh> meshes_of_size(std::span<const ScaledHierarchy> hierarchies, uint64_t triangles) {
    const std::vector<double> errors = errors_of(hierarchies);
    // The least error whose collapses leave few enough; all those below it are done, of its own as many as needed.
    const auto least = std::partition_point(errors.begin(), errors.end() - 1, [&](double error_m) {
        return triangles_at(hierarchies, error_m) > triangles;
    });
    std::vector<Coarsening> states;
    uint64_t sum = 0;
    for (const auto& [hierarchy, scale] : hierarchies) {
        states.emplace_back(*hierarchy);
        if (least != errors.begin()) states.back().run(*(least - 1) / scale, 0, true);
        sum += states.back().triangles();
    }
    for (const bool may_overshoot : {false, true}) {
        for (size_t i = 0; i < states.size() && sum > triangles; ++i) {
            const uint64_t others = sum - states[i].triangles();
            const uint64_t enough = triangles > others ? triangles - others : 0;
            states[i].run(*least / hierarchies[i].scale, enough, may_overshoot);
            sum = others + states[i].triangles();
        }
    }
    // Where the last collapses took two at a time, one that took less may stay undone.
    for (Coarsening& state : states) {
        while (sum < triangles) {
            const uint64_t brought = state.give_back(triangles - sum);
            if (brought == 0) break;
            sum += brought;
        }
    }
    std::vector<StaticMesh> meshes;
    for (const Coarsening& state : states)
        meshes.push_back(state.mesh());
    return meshes;
}

uint64_t count_flipped(const VertexHierarchy& h, const StaticMesh& mesh) {
    const auto normal_of = [&h](const NodeId a, const NodeId b, const NodeId c) {
        const glm::dvec3 from(h.position[a]);
        return glm::cross(glm::dvec3(h.position[b]) - from, glm::dvec3(h.position[c]) - from);
    };
    uint64_t count = 0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto& [leaf_a, leaf_b, leaf_c] = h.triangles[mesh.full_triangle[t]];
        const glm::dvec3 now = normal_of(h.vertex_node[a], h.vertex_node[b], h.vertex_node[c]);
        count += glm::dot(now, normal_of(leaf_a, leaf_b, leaf_c)) < 0.0 ? 1u : 0u;
    }
    return count;
}

uint32_t count_levels(const VertexHierarchy& h) {
    std::vector<uint32_t> below(h.node_count(), 1);
    uint32_t most = h.node_count() > 0 ? 1 : 0;
    for (uint32_t k = 0; k < h.collapse_count(); ++k) {
        const auto [a, b] = h.children[k];
        below[h.leaf_count + k] = 1 + std::max(below[a], below[b]);
        most = std::max(most, below[h.leaf_count + k]);
    }
    return most;
}

}  // namespace lod
