#include "objects/cluster_occlusion.h"

#include <algorithm>
#include <array>

namespace objects {

namespace {

static_assert(Solid::kMostCorners <= lod::OcclusionMap::kMostCorners);

constexpr size_t kFewestOccluders = 16, kMostOccluders = 128;
constexpr double kLeastOccluder_px = 6.0;  ///< radius of its sphere: smaller ones hide little
constexpr uint64_t kSeenPerHidden = 32;    ///< with more, and the fewest occluders, looking does not pay …
constexpr uint32_t kFramesOfRest = 15;     ///< … for so many frames

}  // namespace

/// The largest in a picture, from near to far.
void ClusterOcclusion::select(const ClusterTree& tree, const SceneView& sight, std::span<CutRecord> records,
                              double time_s) {
    chosen_.clear();
    for (CutRecord& record : records) {
        if (!record.is_drawn()) continue;
        const Cluster& cluster = tree.clusters[record.id];
        if (cluster.geometry == kNoGeometry || tree.geometries[cluster.geometry].solid_count == 0) continue;
        const SceneSphere sphere = sphere_at(tree, cluster, time_s);
        const glm::dvec3 centre_eye = sight.eye_from_scene * (sphere.centre - sight.eye_scene);
        const double depth_m = -centre_eye.z;
        if (!(depth_m > sight.metric.near_m) ||
            lod::distance_outside_m(sight.metric, centre_eye, sphere.radius_m) > 0.0)
            continue;
        const double size_px = sight.metric.lambda_px * sphere.radius_m / depth_m;
        if (size_px >= kLeastOccluder_px) chosen_.push_back({&record, size_px, depth_m});
    }
    const auto is_larger = [](const Occluder& a, const Occluder& b) {
        return a.size_px > b.size_px || (a.size_px == b.size_px && a.record->id < b.record->id);
    };
    if (chosen_.size() > most_occluders_) {
        std::nth_element(chosen_.begin(), chosen_.begin() + std::ptrdiff_t(most_occluders_), chosen_.end(),
                         is_larger);
        chosen_.resize(most_occluders_);
    }
    std::sort(chosen_.begin(), chosen_.end(), [](const Occluder& a, const Occluder& b) {
        return a.depth_m < b.depth_m || (a.depth_m == b.depth_m && a.record->id < b.record->id);
    });
}

void ClusterOcclusion::begin(const ClusterTree& tree, std::span<const lod::View> views,
                             std::span<const SceneView> sights, std::span<CutRecord> records, double time_s) {
    maps_.resize(sights.size());
    is_empty_ = true, moves_ = false;
    for (CutRecord& record : records)
        record.is_occluder = false;
    if (rest_ > 0) return;
    for (size_t eye = 0; eye < sights.size(); ++eye) {
        const SceneView& sight = sights[eye];
        maps_[eye].begin(sight.metric, views[eye].width_px, views[eye].height_px);
        select(tree, sight, records, time_s);
        for (const Occluder& occluder : chosen_) {
            const Cluster& cluster = tree.clusters[occluder.record->id];
            const ClusterGeometry& geometry = tree.geometries[cluster.geometry];
            const data::ObjectPose pose = pose_of(tree, cluster, time_s);
            const glm::dmat3 eye_from_geometry = sight.eye_from_scene * glm::mat3_cast(pose.rotation);
            const glm::dvec3 offset = sight.eye_from_scene * (pose.position - sight.eye_scene);
            for (uint32_t i = 0; i < geometry.solid_count; ++i) {
                const Solid& solid = tree.solids[geometry.first_solid + i];
                std::array<glm::dvec3, Solid::kMostCorners> corners;
                for (uint32_t k = 0; k < solid.corner_count; ++k) {
                    const lod::Vertex& vertex = tree.vertices[geometry.first_vertex + solid.corners[k]];
                    corners[k] = eye_from_geometry * lod::position_of(vertex) + offset;
                }
                maps_[eye].add_convex(std::span(corners).first(solid.corner_count));
            }
            occluder.record->is_occluder = true;
            is_empty_ = false;
            moves_ = moves_ || tree.moves(occluder.record->id);
        }
    }
}

void ClusterOcclusion::learn(uint64_t hidden, uint64_t seen) {
    if (rest_ > 0) {
        --rest_;
        return;
    }
    if (most_occluders_ == kFewestOccluders && kSeenPerHidden * hidden < seen) rest_ = kFramesOfRest;
    if (4 * hidden > seen) most_occluders_ = std::min(2 * most_occluders_, kMostOccluders);
    if (8 * hidden < seen) most_occluders_ = std::max(most_occluders_ / 2, kFewestOccluders);
}

void ClusterOcclusion::clear() {
    is_empty_ = true, moves_ = false;
}

}  // namespace objects
