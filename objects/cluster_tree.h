// ClusterTree: hierarchical dynamic levels of detail of a timed scene, built once, drawn at any time from anywhere.
//
//     root                      the virtual node: holds the tops of all classes, is never drawn itself
//      +- cluster               geometry that stands for everything below it, off by at most error_m
//      |   +- cluster           visibility: the share (by weight) of what is below that is there at a time
//      |   |   +- leaf          one object, exact: shared geometry, placed by its motion
//
// A cluster's children are neighbours in the arrays and come after it; siblings are ordered by place. Equal geometries,
// equal visibilities and equal motions are stored once.
//
// Size and weight. The source calls both w_c. Here size_m is the extent (diagonal of the box), which thresholds compare;
// weight_m is additive: an object's extent, a cluster's sum over its objects. With additive weights
// (1 - v_c) * weight_m is exactly the sum of the extents of what is missing, and a connected patch of wrong picture
// is no larger than that sum: timed_error_m is a bound. With the extent in both roles it is not: one missing object of a
// hundred that fill the same box counts a tenth of its size.
//
// Source: Semenov, Shutkin, Zolotov et al., Visualization of large scenes with deterministic dynamics (2020).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "data/timed_scene.h"
#include "lod/draw_list.h"

namespace objects {

using ClusterId = uint32_t;
inline constexpr ClusterId kNoCluster = 0xffffffffu;
inline constexpr ClusterId kRootCluster = 0;

inline constexpr uint32_t kNoGeometry =
    0xffffffffu;  ///< nothing to draw: a front always goes on to the children
inline constexpr uint32_t kSceneFrame = 0xffffffffu;  ///< geometry lies in the scene frame
inline constexpr uint32_t kNoObject = 0xffffffffu;    ///< no leaf
inline constexpr float kNeverEnough_m = 1e30f;  ///< error of what cannot be drawn in place of its children

/// Opaque triangles of a geometry that look about the same way; consecutive ranges make up all of them.
/// Unless said otherwise a range may be seen from anywhere.
struct FacingRange {
    glm::vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit; normals are no farther from it …
    float spread_cos = -2.0f;  ///< … than the angle of this cosine; less than -1: they look anywhere
    float least_offset_m =
        0.0f;  ///< no face's plane passes the geometry's centre nearer, along its normal; may be negative
    uint32_t index_count = 0;
};
static_assert(sizeof(FacingRange) == 24);

/// Convex, closed and opaque: what lies behind the hull of these corners is hidden by the geometry.
struct Solid {
    static constexpr uint32_t kMostCorners = 16;
    std::array<uint32_t, kMostCorners> corners{};  ///< vertices of the geometry
    uint32_t corner_count = 0;                     ///< four at least
};

/// Ranges of ClusterTree::vertices and indices. Indices count from the geometry's first vertex; those of glass come
/// last. A geometry without triangles is one of an object that has none.
struct ClusterGeometry {
    uint32_t first_vertex = 0, vertex_count = 0;
    uint32_t first_index = 0, index_count = 0;    ///< three a triangle, glass included
    uint32_t glass_index_count = 0;               ///< the last so many
    uint32_t first_facing = 0, facing_count = 0;  ///< of ClusterTree::facings; none: seen from anywhere
    uint32_t first_solid = 0, solid_count = 0;    ///< of ClusterTree::solids
    glm::vec3 centre{0.0f};  ///< of a sphere that holds the vertices, when there are facings
    float radius_m = 0.0f;
};

/// One node. Box and sphere are in the scene frame, but for a cluster that moves (`motion` has several keys): there
/// they are in the body frame, like its geometry. Both hold everything below it, at every time. Children of one that moves
/// may have motions of their own; its error holds at every time at which any of it is there.
struct Cluster {
    glm::vec3 box_min{0.0f}, box_max{0.0f};  ///< rounded outwards
    glm::vec3 centre{0.0f};                  ///< bounding sphere
    float radius_m = 0.0f;                   ///< rounded up
    float size_m = 0.0f;                     ///< extent: the longest diagonal of the box
    float error_m =
        0.0f;  ///< epsilon_c, proved: the surfaces of geometry and of all objects below lie within it
               ///< of each other, both ways; 0 for leaves; never less than a child's
    float gamma =
        0.0f;  ///< gamma_c, 0 … 1: how far visibilities below differ from this one, as share of the time
    float unused = 0.0f;    ///< no byte of a file is left to chance
    double weight_m = 0.0;  ///< sum over the objects below; an object's is its size_m
    ClusterId parent = kNoCluster;
    ClusterId first_child = 0;
    uint32_t child_count = 0;  ///< 0: a leaf
    uint32_t geometry = kNoGeometry;
    uint32_t motion = kSceneFrame;  ///< into ClusterTree::motions: scene from geometry
    uint32_t visibility = 0;        ///< into ClusterTree::visibilities
    uint32_t object = kNoObject;    ///< into TimedScene::objects, in every leaf but an empty scene's root
    uint16_t level = 0;             ///< of the build, 0: leaves; larger than any child's
    data::MotionClass motion_class = data::MotionClass::kStatic;
    uint8_t unused_too = 0;
};
static_assert(sizeof(Cluster) == 96);

/// Everything a run time reads; filled by the builder or from a file, never changed afterwards.
struct ClusterTree {
    double end_s = 1.0;           ///< T: visibilities are known on [0, T]
    glm::dvec3 origin_site{0.0};  ///< as in TimedScene
    bool is_on_earth = false;
    uint32_t object_count = 0;  ///< of the scene

    std::vector<Cluster> clusters;            ///< [0] is the root
    std::vector<ClusterGeometry> geometries;  ///< no two alike
    std::vector<lod::Vertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<FacingRange> facings;
    std::vector<Solid> solids;

    /// A motion is a range of keys: one key is a place for ever; the rest as TimedScene says.
    std::vector<data::IndexRange> motions;
    std::vector<data::KeyFrame> keys;

    /// A visibility is a step function on [0, T], a range of the three arrays: from step_time_s[i] on the value is
    /// step_value[i]. The first step is at 0, times rise strictly, neighbours differ.
    std::vector<data::IndexRange> visibilities;
    std::vector<double> step_time_s;
    std::vector<double> step_value;       ///< 0 … 1; exactly 0 (1) when nothing (everything) below is there
    std::vector<double> step_integral_s;  ///< of the function from 0 to this step

    bool is_leaf(ClusterId id) const { return clusters[id].child_count == 0; }
    bool moves(ClusterId id) const {
        const uint32_t motion = clusters[id].motion;
        return motion != kSceneFrame && motions[motion].size() > 1;
    }
};

/// The step of a visibility that holds at a time, an index of the step arrays.
/// @param time_s  clamped to [0, T]; not NaN
/// Cost: O(log steps).
uint32_t step_at(const ClusterTree& tree, uint32_t visibility, double time_s);

/// Value of a visibility at a time, and its integral from 0 to that time, s; both exact for the stored steps.
double visibility_at(const ClusterTree& tree, uint32_t visibility, double time_s);
double visibility_integral_s(const ClusterTree& tree, uint32_t visibility, double time_s);

/// delta_c(t): how wrong the picture of this cluster alone is when `visibility` of it is there: drawn from 1/2 on, not
/// drawn below. A length: no surface is off by more, and no connected patch that is wrongly there or wrongly missing
/// extends farther. 0 when nothing is there.
/// @returns metres, finite, >= 0; at most kNeverEnough_m
double timed_error_m(const Cluster& cluster, double visibility);

}  // namespace objects
