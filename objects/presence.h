// Presence: where on its visibility's step function a cluster is, and for how long that stays so.
#pragma once

#include "objects/cluster_tree.h"

namespace objects {

struct Presence {
    double share = 0.0;  ///< v_c, 0 … 1
    double begin_s = 0.0,
           end_s = 0.0;  ///< holds from begin_s, included, to end_s, excluded; infinite at the ends

    bool holds_at(double time_s) const { return time_s >= begin_s && time_s < end_s; }
};

/// @param time_s  in [0, T]
/// Cost: O(log steps).
Presence presence_at(const ClusterTree& tree, uint32_t visibility, double time_s);

/// A schedule's time as trees know it: within [0, T]; NaN counts as 0.
double clamped_time(const ClusterTree& tree, double time_s);

}  // namespace objects
