#include "objects/cluster_tree.h"

#include <algorithm>

#include "lod/base/check.h"

namespace objects {

uint32_t step_at(const ClusterTree& tree, uint32_t visibility, double time_s) {
    const data::IndexRange range = tree.visibilities[visibility];
    DCHECK(range.begin < range.end);
    const auto begin = tree.step_time_s.begin();
    const auto after = std::upper_bound(begin + range.begin + 1, begin + range.end, time_s);
    return static_cast<uint32_t>(after - begin) - 1;
}

double visibility_at(const ClusterTree& tree, uint32_t visibility, double time_s) {
    return tree.step_value[step_at(tree, visibility, std::min(time_s, tree.end_s))];
}

double visibility_integral_s(const ClusterTree& tree, uint32_t visibility, double time_s) {
    const double time = std::clamp(time_s, 0.0, tree.end_s);
    const uint32_t step = step_at(tree, visibility, time);
    return tree.step_integral_s[step] + tree.step_value[step] * (time - tree.step_time_s[step]);
}

double timed_error_m(const Cluster& cluster, double visibility) {
    if (visibility <= 0.0) return 0.0;
    const double error = double(cluster.error_m);
    if (visibility >= 1.0) return error;
    const double wrong = (visibility >= 0.5 ? 1.0 - visibility : visibility) * cluster.weight_m;
    // What is wrong lies inside the box: no patch of it is larger.
    return std::min(error + std::min(wrong, double(cluster.size_m)), double(kNeverEnough_m));
}

}  // namespace objects
