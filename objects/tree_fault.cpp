#include <cmath>

#include "objects/tree_file.h"

namespace objects {
namespace {

bool is_within(const data::IndexRange& range, size_t size) {
    return range.begin <= range.end && range.end <= size;
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string fault_of_cluster(const ClusterTree& tree, size_t id) {
    const Cluster& cluster = tree.clusters[id];
    const std::string name = "cluster " + std::to_string(id);
    const bool is_root = id == kRootCluster;
    if (is_root ? cluster.parent != kNoCluster : cluster.parent >= id)
        return name + " before its parent; expected parents first";
    if (cluster.child_count > 0 &&
        (cluster.first_child <= id ||
         uint64_t{cluster.first_child} + cluster.child_count > tree.clusters.size()))
        return name + " whose children lie outside the tree; expected them behind it";
    for (uint32_t i = 0; i < cluster.child_count; ++i) {
        if (tree.clusters[cluster.first_child + i].parent != id)
            return name + " beside its children; expected them to name it as parent";
    }
    if (cluster.geometry != kNoGeometry && cluster.geometry >= tree.geometries.size())
        return name + " without its geometry; expected one of the file's";
    if (cluster.motion != kSceneFrame && cluster.motion >= tree.motions.size())
        return name + " without its motion; expected one of the file's";
    if (cluster.visibility >= tree.visibilities.size())
        return name + " without its visibility; expected one of the file's";
    if (!is_finite(cluster.centre) || !is_finite(cluster.box_min) || !is_finite(cluster.box_max))
        return name + " in no place; expected finite coordinates";
    if (!(cluster.radius_m >= 0.0f) || !(cluster.size_m >= 0.0f) || !(cluster.error_m >= 0.0f) ||
        !std::isfinite(cluster.radius_m) || !std::isfinite(cluster.size_m) || !std::isfinite(cluster.error_m))
        return name + " of no size; expected finite lengths >= 0";
    if (!(cluster.weight_m >= 0.0) || !std::isfinite(cluster.weight_m))
        return name + " of no weight; expected a finite length >= 0";
    return {};
}

std::string fault_of_geometry(const ClusterTree& tree, const ClusterGeometry& geometry) {
    if (uint64_t{geometry.first_vertex} + geometry.vertex_count > tree.vertices.size() ||
        uint64_t{geometry.first_index} + geometry.index_count > tree.indices.size() ||
        geometry.glass_index_count > geometry.index_count)
        return "a geometry outside its arrays; expected ranges of them";
    for (uint32_t i = 0; i < geometry.index_count; ++i) {
        if (tree.indices[geometry.first_index + i] >= geometry.vertex_count)
            return "an index outside its geometry; expected one of its vertices";
    }
    if (uint64_t{geometry.first_solid} + geometry.solid_count > tree.solids.size())
        return "a geometry outside its solids; expected a range of the file's";
    for (uint32_t i = 0; i < geometry.solid_count; ++i) {
        const Solid& solid = tree.solids[geometry.first_solid + i];
        if (solid.corner_count < 4 || solid.corner_count > Solid::kMostCorners)
            return "a solid of " + std::to_string(solid.corner_count) + " corners; expected 4 to 16";
        for (uint32_t k = 0; k < solid.corner_count; ++k) {
            if (solid.corners[k] >= geometry.vertex_count)
                return "a solid's corner outside its geometry; expected one of its vertices";
        }
    }
    if (geometry.facing_count == 0) return {};
    if (uint64_t{geometry.first_facing} + geometry.facing_count > tree.facings.size() ||
        !is_finite(geometry.centre) || !(geometry.radius_m >= 0.0f))
        return "a geometry that looks nowhere; expected ranges of the file's";
    uint64_t total = geometry.glass_index_count;
    for (uint32_t i = 0; i < geometry.facing_count; ++i) {
        const FacingRange& range = tree.facings[geometry.first_facing + i];
        if (!is_finite(range.axis) || !(range.spread_cos <= 1.0f) || !std::isfinite(range.least_offset_m))
            return "triangles that look nowhere; expected a direction";
        total += range.index_count;
    }
    if (total != geometry.index_count) return "a geometry of two sizes; expected ranges that fill it";
    return {};
}

std::string fault_of_motion(const ClusterTree& tree, const data::IndexRange& range) {
    if (range.size() == 0 || !is_within(range, tree.keys.size()))
        return "a motion without keys; expected one at least";
    for (uint32_t i = range.begin; i < range.end; ++i) {
        const data::KeyFrame& key = tree.keys[i];
        const double sum =
            key.position.x + key.position.y + key.position.z + glm::dot(key.rotation, key.rotation);
        if (!std::isfinite(sum) || !std::isfinite(key.time_s))
            return "a key frame nowhere; expected finite numbers";
        if (i > range.begin && !(tree.keys[i - 1].time_s < key.time_s))
            return "key frames out of order; expected times that rise";
    }
    return {};
}

std::string fault_of_visibility(const ClusterTree& tree, const data::IndexRange& range) {
    if (range.size() == 0 || !is_within(range, tree.step_time_s.size()))
        return "a visibility without steps; expected one at least";
    if (tree.step_time_s[range.begin] != 0.0)
        return "a visibility that begins late; expected its first step at 0";
    for (uint32_t i = range.begin; i < range.end; ++i) {
        if (!(tree.step_value[i] >= 0.0 && tree.step_value[i] <= 1.0))
            return "a visibility of " + std::to_string(tree.step_value[i]) + "; expected 0 to 1";
        if (!std::isfinite(tree.step_time_s[i]) ||
            (i > range.begin && !(tree.step_time_s[i - 1] < tree.step_time_s[i])))
            return "steps of a visibility out of order; expected times that rise";
    }
    return {};
}

}  // namespace

std::string fault_of(const ClusterTree& tree) {
    if (tree.clusters.empty()) return "no cluster; expected a root";
    if (!(tree.end_s > 0.0) || !std::isfinite(tree.end_s))
        return "no time span; expected a finite end after 0";
    if (tree.step_value.size() != tree.step_time_s.size() ||
        tree.step_integral_s.size() != tree.step_time_s.size())
        return "steps without values; expected arrays of one length";
    for (const ClusterGeometry& geometry : tree.geometries) {
        if (std::string fault = fault_of_geometry(tree, geometry); !fault.empty()) return fault;
    }
    for (const data::IndexRange& range : tree.motions) {
        if (std::string fault = fault_of_motion(tree, range); !fault.empty()) return fault;
    }
    for (const data::IndexRange& range : tree.visibilities) {
        if (std::string fault = fault_of_visibility(tree, range); !fault.empty()) return fault;
    }
    for (size_t id = 0; id < tree.clusters.size(); ++id) {
        if (std::string fault = fault_of_cluster(tree, id); !fault.empty()) return fault;
    }
    return {};
}

}  // namespace objects
