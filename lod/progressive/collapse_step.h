// CollapseStep: a collapse (a, b) -> p as it is handed from whoever makes it to whoever follows: proof and bounds.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

struct CollapseStep {
    std::array<NodeId, 2> children{};
    glm::vec3 position{0.0f};  ///< of p, mesh frame
    std::span<const CornerId>
        kept;  ///< corners of both children that are p's from now on; the triangles live on
    std::span<const uint32_t> removed;  ///< triangles that hold both children
};

/// The k-th of a hierarchy, into which it points.
inline CollapseStep step_of(const VertexHierarchy& h, uint32_t k) {
    return {h.children[k], h.position[h.leaf_count + k],
            std::span(h.kept).subspan(h.kept_begin[2 * k], h.kept_begin[2 * k + 2] - h.kept_begin[2 * k]),
            std::span(h.removed).subspan(h.removed_begin[k], h.removed_begin[k + 1] - h.removed_begin[k])};
}

/// Some collapses in a row, for another thread.
class CollapseBatch {
  public:
    size_t size() const { return entries_.size(); }
    void add(const CollapseStep& step) {
        kept_.insert(kept_.end(), step.kept.begin(), step.kept.end());
        removed_.insert(removed_.end(), step.removed.begin(), step.removed.end());
        entries_.push_back({step.children, step.position, kept_.size(), removed_.size()});
    }
    /// @param k  below size()
    CollapseStep operator[](size_t k) const {
        const size_t kept = k == 0 ? 0 : entries_[k - 1].kept_end,
                     removed = k == 0 ? 0 : entries_[k - 1].removed_end;
        const Entry& entry = entries_[k];
        return {entry.children, entry.position, std::span(kept_).subspan(kept, entry.kept_end - kept),
                std::span(removed_).subspan(removed, entry.removed_end - removed)};
    }

  private:
    struct Entry {
        std::array<NodeId, 2> children{};
        glm::vec3 position{0.0f};
        size_t kept_end = 0, removed_end = 0;
    };
    std::vector<Entry> entries_;
    std::vector<CornerId> kept_;
    std::vector<uint32_t> removed_;
};

}  // namespace lod
