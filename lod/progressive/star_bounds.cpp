#include "lod/progressive/star_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/progressive/coarse_mesh.h"
#include "lod/progressive/segment_distance.h"

namespace lod {

StarBounds::StarBounds(std::span<const glm::vec3> leaves, size_t corner_count)
    : positions_(leaves.begin(), leaves.end()),
      edge_bound_m_(corner_count, 0.0),
      node_bound_m_(leaves.size(), 0.0),
      errors_m_(leaves.size(), 0.0f),
      noise_m_(noise_m(leaves)) {
    const size_t most_nodes = 2 * leaves.size();  // a collapse makes one of two
    positions_.reserve(most_nodes);
    node_bound_m_.reserve(most_nodes);
    errors_m_.reserve(most_nodes);
}

/// The squared distance of a full edge from a spoke of the newest node, or more, up to `unnoticed2`.
double StarBounds::crossing2(const StarMeasures::Crossing& crossing, const StarMeasures::Spoke& spoke,
                             double unnoticed2) const {
    const glm::dvec3 &u = positions_[crossing.u], &v = positions_[crossing.v];
    const glm::dvec3 &from = positions_.back(), &to = positions_[spoke.ring];
    const double guess2 = squared_distance_of_pair(u, v, from, to);
    return guess2 <= unnoticed2 ? guess2 : std::min(guess2, squared_segment_distance(u, v, from, to));
}

double StarBounds::passing2(const StarMeasures::Passing& passing) const {
    const glm::dvec3& node = positions_[passing.node];
    return squared_distance(node, nearest_on_segment(node, positions_[passing.u], positions_[passing.v]));
}

std::span<const float> StarBounds::take(const StarMeasures& measures) {
    size_t spoke_at = 0, crossing_at = 0, passing_at = 0;
    const auto farthest_passing2 = [&](uint32_t end) {
        double most2 = 0.0;
        for (; passing_at < end; ++passing_at)
            most2 = std::max(most2, passing2(measures.passings[passing_at]));
        return most2;
    };
    for (const StarMeasures::Star& star : measures.stars) {
        positions_.emplace_back(star.position);
        const double node_m = std::max(star.owner_m, glm::sqrt(farthest_passing2(star.passings_end)));
        node_bound_m_.push_back(node_m);
        double bound_m = std::max(star.vertices_m, node_m);
        for (; spoke_at < star.spokes_end; ++spoke_at) {
            const StarMeasures::Spoke& spoke = measures.spokes[spoke_at];
            double most2 = farthest_passing2(spoke.passings_end);
            for (; crossing_at < spoke.crossings_end; ++crossing_at)
                most2 = std::max(most2, crossing2(measures.crossings[crossing_at], spoke, most2));
            const double edge_m = glm::sqrt(most2);
            edge_bound_m_[spoke.corner] = edge_m;
            if (spoke.mate != kNoCorner) edge_bound_m_[spoke.mate] = edge_m;
            bound_m = std::max({bound_m, edge_m, edge_bound_m_[spoke.outer], node_bound_m_[spoke.ring],
                                node_bound_m_[spoke.next_ring]});
        }
        add_node(star, bound_m);
    }
    return std::span(errors_m_).last(measures.stars.size());
}

void StarBounds::add_node(const StarMeasures::Star& star, double bound_m) {
    auto error_m = static_cast<float>(bound_m);
    if (double(error_m) < bound_m) error_m = std::nextafter(error_m, std::numeric_limits<float>::max());
    errors_m_.push_back(std::max(
        {errors_m_[star.children[0]], errors_m_[star.children[1]], bound_m > noise_m_ ? error_m : 0.0f}));
}

}  // namespace lod
