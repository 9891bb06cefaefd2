// StarBounds: errors of nodes from what a SurfaceImage says is to be measured.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/progressive/star_measures.h"

namespace lod {

/// A node's error bounds all triangles that its collapse makes, and is no less than its children's. What is below the
/// coordinates' noise counts as 0.
/// Cost: about 1.2 us a collapse.
class StarBounds {
  public:
    /// @param leaves        places, mesh frame
    /// @param corner_count  of the full mesh
    StarBounds(std::span<const glm::vec3> leaves, size_t corner_count);

    /// Takes collapses in their order. @returns the errors of their nodes, m
    std::span<const float> take(const StarMeasures& measures);
    /// error_m of a hierarchy: of all nodes so far, leaves first.
    const std::vector<float>& errors_m() const { return errors_m_; }

  private:
    double crossing2(const StarMeasures::Crossing& crossing, const StarMeasures::Spoke& spoke,
                     double unnoticed2) const;
    double passing2(const StarMeasures::Passing& passing) const;
    void add_node(const StarMeasures::Star& star, double bound_m);

    std::vector<glm::dvec3> positions_;  // [nodes so far]
    std::vector<double> edge_bound_m_;   // [corners] crossings of that edge
    std::vector<double> node_bound_m_;   // [nodes so far] owner or passings
    std::vector<float> errors_m_;        // [nodes so far]
    double noise_m_;                     // of the coordinates
};

}  // namespace lod
