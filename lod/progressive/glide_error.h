// GlideError: how many pixels a body's surface may be off while vertices of it glide.
//
// No point moves farther than the farthest vertex. Of most vertices no more is asked. The farthest are looked at one by
// one (slide_bound.h) and set out in steps: a vertex comes after its neighbours that were looked at before, so those of
// one step have no edge in common and cost no more than the worst of them; a step moves what the steps before have left,
// so steps add up. All others follow at once, in a last step that costs as much as the farthest of them is away.
//
//     error <= sum over steps (worst slide of the step) + farthest of all others
#pragma once

#include <span>
#include <vector>

#include "lod/progressive/mesh_cut.h"
#include "lod/progressive/node_glides.h"
#include "lod/progressive/slide_bound.h"
#include "lod/sight_metric.h"

namespace lod {

class GlideError {
  public:
    /// @return beyond what the cut itself is off, pixels of the worst view; 0 when nothing glides
    /// Cost: about 15 ns a glide, 0.5 us for each that is looked at, 128 at most. Allocates while it gets larger.
    double measure_px(const MeshCut& cut, const NodeGlides& glides, std::span<const AnchoredEye> eyes);

  private:
    struct Way {
        double px = 0.0;  ///< that the vertex is away from its place
        uint32_t glide = 0;
    };

    void sort_ways(const MeshCut& cut, std::span<const NodeGlide> glides, std::span<const AnchoredEye> eyes);
    int look_around(const MeshCut& cut, const NodeGlides& glides, NodeId node);
    double step_out_px(const MeshCut& cut, const NodeGlides& glides, std::span<const AnchoredEye> eyes,
                       const Way& way);

    std::vector<Way> ways_;        ///< farthest first, as far as they are looked at
    std::vector<int> steps_;       ///< [glides]; negative: with all others
    std::vector<double> step_px_;  ///< [steps]
    std::vector<OuterEdge> star_;  ///< as the steps so far show it
};

}  // namespace lod
