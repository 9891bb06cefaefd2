// EdgeWords: for every edge of a full mesh the path its image takes over a coarser mesh.
//
// A path is a word of letters, each the half-edge through which it leaves a triangle. An inverse pair, out and back
// through the same edge, says nothing and may be cancelled.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/base/short_list.h"
#include "lod/progressive/coarse_mesh.h"

namespace lod {

using Word = ShortList<CornerId, 10>;
/// Words one after the other, of a closed path.
using Loop = std::vector<CornerId>;

/// Appends a letter, or takes the last one away when it is the inverse and both are of an edge at `node`.
inline void append_reduced(const CoarseMesh& mesh, NodeId node, CornerId letter, Word& word) {
    if (!word.empty() && word.back() == mesh.mate(letter) &&
        (mesh.node(letter) == node || mesh.head(letter) == node)) {
        word.pop_back();
    } else {
        word.push_back(letter);
    }
}

/// Letters from sector `from` of a fan to sector `to`, counter-clockwise or clockwise, to `visit` one by one. For a
/// fan that is open only the way that does not leave it.
template <typename Visit>
void walk_fan(const Fan& fan, size_t from, size_t to, bool is_ccw, const Visit& visit) {
    const size_t count = fan.corners.size();
    for (size_t at = from; at != to;) {
        visit(is_ccw ? prev_corner(fan.corners[at]) : fan.corners[at]);
        at = is_ccw ? (at + 1) % count : (at + count - 1) % count;
    }
}

/// Whether closed paths can be drawn together; keeps what it needs for that.
class Filling {
  public:
    /// Whether a path, started anywhere, can be drawn together to a point without crossing any node but `pierced`.
    /// Greedy: a run round a pierced node that is longer than half of its fan goes the other way. May fail to see that
    /// it can, never the reverse.
    /// @param loop  the path; used up
    bool is_fillable(const CoarseMesh& mesh, Loop& loop, std::span<const NodeId> pierced,
                     std::span<const CornerId> corner_of_node);

  private:
    bool shorten_round(const CoarseMesh& mesh, NodeId node, CornerId corner, Loop& loop);

    Fan fan_;
    Loop other_;
};

}  // namespace lod
