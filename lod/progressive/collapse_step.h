// CollapseStep: a collapse (a, b) -> p as it is handed from whoever makes it to whoever follows: proof and bounds.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

struct CollapseStep {
    std::array<NodeId, 2> children{};
    glm::vec3 position{0.0f};           ///< of p, mesh frame
    std::span<const CornerId> kept;     ///< corners of both children that are p's from now on; the triangles live on
    std::span<const uint32_t> removed;  ///< triangles that hold both children
};

/// The k-th of a hierarchy, into which it points.
inline CollapseStep step_of(const VertexHierarchy& h, uint32_t k) {
    return {h.children[k], h.position[h.leaf_count + k],
            std::span(h.kept).subspan(h.kept_begin[2 * k], h.kept_begin[2 * k + 2] - h.kept_begin[2 * k]),
            std::span(h.removed).subspan(h.removed_begin[k], h.removed_begin[k + 1] - h.removed_begin[k])};
}

}  // namespace lod
