// RivalFront: what the methods that ROAM is compared with offer beyond lod::Front.
//
// Each is written plainly and to its own advantage: errors are true maxima over all samples, bounds in pixels are
// taken over oriented boxes, static geometry stays in the pool. Voids are drawn at their harmless heights.
#pragma once

#include "lod/front.h"

namespace terrain {

class RivalFront : public lod::Front {
  public:
    /// Bytes held beside the height grid and the geometry pool (whose bytes follow from pool_need()): errors,
    /// bounds, precomputed sequences, queues.
    virtual uint64_t memory_bytes() const = 0;
};

}  // namespace terrain
