#include "objects/display.h"

#include <algorithm>

namespace objects {
namespace {

struct Traversal {
    const ClusterTree& tree;
    std::span<const SceneView> views;
    double time_s, tolerance_px;
    std::vector<ClusterId>& drawn;
    double error_px = 0.0;

    void visit(ClusterId id) {
        const Cluster& cluster = tree.clusters[id];
        const double visibility = visibility_at(tree, cluster.visibility, time_s);
        if (visibility <= 0.0) return;
        ClusterSight sight;
        for (const SceneView& view : views) {
            const ClusterSight one =
                sight_of(view, box_in_eye(tree, cluster, view, time_s), timed_error_m(cluster, visibility));
            sight.is_seen = sight.is_seen || one.is_seen;
            sight.error_px = std::max(sight.error_px, one.error_px);
        }
        if (!sight.is_seen) return;
        if (sight.error_px > tolerance_px && cluster.child_count > 0) {
            for (uint32_t child = 0; child < cluster.child_count; ++child)
                visit(cluster.first_child + child);
            return;
        }
        error_px = std::max(error_px, sight.error_px);
        if (visibility >= 0.5 && cluster.geometry != kNoGeometry) drawn.push_back(id);
    }
};

}  // namespace

double display(const ClusterTree& tree, std::span<const SceneView> views, double time_s, double tolerance_px,
               std::vector<ClusterId>& drawn) {
    drawn.clear();
    Traversal traversal{tree, views, time_s, tolerance_px, drawn};
    traversal.visit(kRootCluster);
    return traversal.error_px;
}

}  // namespace objects
