#include "objects/presence.h"

#include <algorithm>
#include <limits>

namespace objects {

Presence presence_at(const ClusterTree& tree, uint32_t visibility, double time_s) {
    constexpr double kForEver_s = std::numeric_limits<double>::infinity();
    const uint32_t step = step_at(tree, visibility, time_s);
    const data::IndexRange range = tree.visibilities[visibility];
    return {tree.step_value[step], step == range.begin ? -kForEver_s : tree.step_time_s[step],
            step + 1 == range.end ? kForEver_s : tree.step_time_s[step + 1]};
}

double clamped_time(const ClusterTree& tree, double time_s) {
    return time_s > 0.0 ? std::min(time_s, tree.end_s) : 0.0;  // NaN is not above 0
}

}  // namespace objects
