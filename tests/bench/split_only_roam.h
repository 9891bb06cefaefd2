// The rival: split-only ROAM rebuilt from the base mesh every frame, without queues and without memory of the last
// frame. Triangles in a pool with neighbour pointers, split recursively while the screen error of a triangle
// exceeds the tolerance; the scheme of B. Turner, Real-time dynamic level of detail terrain rendering with ROAM
// (2000). Same errors and same metric as terrain::RoamFront, so both make meshes of the same accuracy.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lod/sight_metric.h"
#include "terrain/diamond_table.h"

namespace bench {

/// Planar 2^k + 1 grids only.
class SplitOnlyRoam {
  public:
    SplitOnlyRoam(const data::HeightGrid& grid, const terrain::DiamondTable& table) : table_(table) {
        cell_m_ = static_cast<float>(grid.frame.cell_m().x);
        for (int level = 0; level <= table.domain.finest_level(); ++level) {
            reach_m_.push_back(static_cast<float>(table.domain.reach(level)) * cell_m_ *
                               ((level & 1) != 0 ? 1.0f : 1.41421356f));
        }
        origin_ = grid.frame.world_from_sample(0, 0, 0.0);
        nodes_.resize(4'000'000);
    }

    /// Builds the mesh of one view; returns the number of leaf triangles.
    uint64_t build(const lod::View& view, double tolerance_px) {
        eye_.emplace(view, origin_);
        tolerance_px_ = static_cast<float>(tolerance_px);
        used_ = 0;
        leaves_ = 2;
        splits_ = 0;
        const int side = table_.domain.side();
        const uint32_t a = make(), b = make();
        nodes_[a].base = b;
        nodes_[b].base = a;
        visit(a, 0, {0, side}, {0, 0}, {side, side});
        visit(b, 0, {side, 0}, {side, side}, {0, 0});
        return leaves_;
    }
    uint64_t splits() const { return splits_; }

  private:
    static constexpr uint32_t kNone = 0xffffffffu;
    struct Node {
        uint32_t left = kNone, right = kNone;  ///< children
        uint32_t base = kNone, left_neighbour = kNone, right_neighbour = kNone;
    };

    uint32_t make() {
        nodes_[used_] = Node{};
        return used_++;
    }

    void replace_neighbour(uint32_t node, uint32_t old_one, uint32_t new_one) {
        if (node == kNone) return;
        Node& n = nodes_[node];
        if (n.base == old_one)
            n.base = new_one;
        else if (n.left_neighbour == old_one)
            n.left_neighbour = new_one;
        else if (n.right_neighbour == old_one)
            n.right_neighbour = new_one;
    }

    void split(uint32_t node) {
        if (nodes_[node].left != kNone) return;
        const uint32_t base = nodes_[node].base;
        if (base != kNone && nodes_[base].base != node) split(base);
        const uint32_t left = make(), right = make();
        ++leaves_;
        ++splits_;
        Node& n = nodes_[node];
        n.left = left;
        n.right = right;
        nodes_[left].base = n.left_neighbour;
        nodes_[left].left_neighbour = right;
        nodes_[right].base = n.right_neighbour;
        nodes_[right].right_neighbour = left;
        replace_neighbour(n.left_neighbour, node, left);
        replace_neighbour(n.right_neighbour, node, right);
        if (n.base == kNone) return;
        Node& opposite = nodes_[n.base];
        if (opposite.left != kNone) {
            nodes_[opposite.left].right_neighbour = right;
            nodes_[opposite.right].left_neighbour = left;
            nodes_[left].right_neighbour = opposite.right;
            nodes_[right].left_neighbour = opposite.left;
        } else {
            split(n.base);
        }
    }

    bool is_wanted(terrain::GridPoint middle, int level) const {
        const terrain::DiamondSource source = table_.at(middle, level);
        if (source.error_code == 0) return false;
        terrain::DiamondBound bound;
        bound.error_m = source.error_m();
        const float reach = reach_m_[static_cast<size_t>(level)], rise = source.rise_m();
        bound.radius_m = std::sqrt(reach * reach + rise * rise) + bound.error_m;
        bound.centre = {static_cast<float>(middle.x) * cell_m_, -static_cast<float>(middle.y) * cell_m_,
                        source.height_m};
        const glm::vec3 centre = eye_->to_eye(bound.centre);
        if (eye_->distance_outside_m(centre, bound.radius_m) > 0.0f) return false;
        return error_px(bound, centre) > tolerance_px_;
    }

    /// lod::screen_error_px in single precision, for one sphere.
    float error_px(const terrain::DiamondBound& bound, const glm::vec3& centre) const {
        const float distance = std::sqrt(glm::dot(centre, centre)), front = -centre.z - bound.radius_m;
        const float depth =
            std::max({front, (distance - bound.radius_m) * eye_->inverse_stretch, eye_->near_m});
        const float slant =
            std::min(eye_->stretch, (distance + bound.radius_m) / std::max(front, eye_->near_m));
        return eye_->lambda_px * bound.error_m * std::max(slant, 1.0f) / depth;
    }

    /// The triangle `node`, whose hypotenuse has its middle at a diamond of `level`.
    void visit(uint32_t node, int level, terrain::GridPoint apex, terrain::GridPoint left,
               terrain::GridPoint right) {
        if (level > table_.domain.finest_level()) return;
        const terrain::GridPoint middle{(left.x + right.x) / 2, (left.y + right.y) / 2};
        if (nodes_[node].left == kNone) {
            if (!is_wanted(middle, level)) return;
            split(node);
        }
        visit(nodes_[node].left, level + 1, middle, apex, left);
        visit(nodes_[node].right, level + 1, middle, right, apex);
    }

    const terrain::DiamondTable& table_;
    float cell_m_ = 1.0f;
    std::vector<float> reach_m_;
    glm::dvec3 origin_{0.0};
    std::optional<lod::AnchoredEye> eye_;
    float tolerance_px_ = 1.0f;
    std::vector<Node> nodes_;
    uint32_t used_ = 0;
    uint64_t leaves_ = 0, splits_ = 0;
};

}  // namespace bench
