// What ClusterFront hands to the renderer, and its proof.
#include <algorithm>
#include <glm/gtc/matrix_access.hpp>

#include "lod/base/check.h"
#include "objects/cluster_front.h"
#include "objects/cluster_items.h"

namespace objects {

lod::PoolRegion ClusterFront::pool_need() const {
    const auto indices = static_cast<uint32_t>(tree_.indices.size());
    const uint32_t room = hiding_ == Hiding::kTriangles ? ClusterSieve::kRoom : 0;
    return {0, static_cast<uint32_t>(tree_.vertices.size()), 0, indices + room};
}

void ClusterFront::place(const lod::PoolRegion& region) {
    const lod::PoolRegion need = pool_need();
    CHECK(region.vertex_capacity >= need.vertex_capacity && region.index_capacity >= need.index_capacity);
    region_ = region;
    is_written_ = false;
}

void ClusterFront::emit_writes(lod::DrawList& out) {
    if (is_written_ || tree_.vertices.empty()) return;
    out.vertex_writes.push_back({region_.first_vertex, tree_.vertices});
    if (!tree_.indices.empty()) out.index_writes.push_back({region_.first_index, tree_.indices});
    is_written_ = true;
}

/// Near ones first: they hide what comes after them, from the sieve and from the rasteriser's shading.
void ClusterFront::line_up(const SceneView& sight) {
    line_.clear();
    const bool is_only_eye = views_.size() == 1;
    const glm::dvec3 ahead = -glm::row(sight.eye_from_scene, 2);
    for (const CutRecord& record : cut_) {
        if (!record.is_drawn()) continue;
        const Cluster& cluster = tree_.clusters[record.id];
        if (!is_only_eye && lod::is_outside(sight.metric, box_in_eye(tree_, cluster, sight, time_s_)))
            continue;
        const SceneSphere sphere = sphere_at(tree_, cluster, time_s_);
        line_.push_back({static_cast<float>(glm::dot(ahead, sphere.centre - sight.eye_scene)), record.id});
    }
    std::sort(line_.begin(), line_.end(), [](const Drawn& a, const Drawn& b) {
        return a.depth_m < b.depth_m || (a.depth_m == b.depth_m && a.id < b.id);
    });
}

void ClusterFront::emit(const lod::View& view, lod::DrawList& out) {
    settle();
    emit_writes(out);
    const SceneView sight(view, place_);
    line_up(sight);
    ClusterItems items(tree_, place_, region_, view, time_s_);
    const ClusterSieve::Scene scene{tree_, region_, view, sight, time_s_};
    const bool sifts = hiding_ == Hiding::kTriangles;
    if (sifts) sieve_.begin(view);
    for (const Drawn& drawn : line_) {
        const size_t first_item = out.items.size();
        items.add(drawn.id, out);
        if (sifts) sieve_.add(scene, tree_.clusters[drawn.id], first_item, out);
    }
    emitted_ = items.triangles();
    if (sifts) emitted_ -= sieve_.finish(scene, threads_, out);
}

void ClusterFront::drawn(std::vector<ClusterId>& drawn) const {
    drawn.clear();
    for (const CutRecord& record : cut_) {
        if (record.is_drawn() && tree_.clusters[record.id].geometry != kNoGeometry)
            drawn.push_back(record.id);
    }
    std::sort(drawn.begin(), drawn.end());
}

uint64_t ClusterFront::memory_bytes() const {
    return cut_.memory_bytes() + worst_.memory_bytes() + cheapest_.memory_bytes() +
           stack_.capacity() * sizeof(ClusterId) + line_.capacity() * sizeof(Drawn) + sieve_.memory_bytes();
}

std::string ClusterFront::validate() const {
    uint64_t triangles = 0, hash = 0, leaves = 0;
    if (!cut_.holds(kRootCluster)) return "the root is not in the cut";
    // Every way from the root must end at exactly one active cluster: walk them all.
    std::vector<ClusterId> ways{kRootCluster};
    size_t met = 0;
    while (!ways.empty()) {
        const ClusterId id = ways.back();
        ways.pop_back();
        if (!cut_.holds(id)) return "cluster " + std::to_string(id) + " is missing below a refined one";
        ++met;
        const CutRecord& record = cut_.at(id);
        if (record.id != id)
            return "cluster " + std::to_string(id) + " is filed as " + std::to_string(record.id);
        const Cluster& cluster = tree_.clusters[id];
        if (record.presence.share != visibility_at(tree_, cluster.visibility, std::max(time_s_, 0.0)))
            return "presence of cluster " + std::to_string(id) + " is out of date";
        if (record.is_refined) {
            if (cluster.child_count == 0) return "leaf " + std::to_string(id) + " is refined";
            for (uint32_t i = 0; i < cluster.child_count; ++i)
                ways.push_back(cluster.first_child + i);
            continue;
        }
        if (needs_children(record))
            return "cluster " + std::to_string(id) + " is in view and has nothing to draw";
        ++leaves;
        hash += cluster_hash(id);
        if (record.presence.share >= 0.5 && cluster.geometry != kNoGeometry)
            triangles += tree_.geometries[cluster.geometry].index_count / 3;
    }
    if (met != cut_.size())
        return std::to_string(cut_.size()) + " clusters are in the cut, " + std::to_string(met) +
               " can be reached";
    if (triangles != triangles_)
        return std::to_string(triangles_) + " triangles are told, " + std::to_string(triangles) +
               " are there";
    if (hash != hash_) return "the hash of " + std::to_string(leaves) + " active clusters is out of date";
    return {};
}

}  // namespace objects
