// Draft: a cluster tree while it grows: clusters by number, children by lists, geometry as soups.
#pragma once

#include <span>
#include <vector>

#include "objects/clustering/build_counts.h"
#include "objects/clustering/build_options.h"
#include "objects/clustering/geometry_pool.h"
#include "objects/clustering/relative_motion.h"
#include "objects/clustering/step_function.h"

namespace objects {

inline constexpr uint32_t kNone = 0xffffffffu;

/// The frame of a body that is one of several under another body's: where it is there, and how far off that at most.
struct Carriage {
    FramePlace place;
    double drift_m = 0.0;
};

/// Box, sphere and soup are in the frame of the hierarchy the cluster belongs to: the scene's, or a moving body's.
struct DraftCluster {
    glm::dvec3 box_min{0.0}, box_max{0.0};  ///< of everything below, and of its own geometry
    double weight_m = 0.0, error_m = 0.0, gamma = 0.0;
    std::vector<uint32_t> children;
    uint32_t visibility = 0;  ///< into Draft::functions
    uint32_t motion =
        kSceneFrame;  ///< into Draft::motions: hierarchy's frame (or scene's) from drawn geometry
    uint32_t geometry = kNoGeometry;  ///< in the pool
    uint32_t mesh = kNone;      ///< geometry is this mesh, or a rung of its chain, placed by its motion …
    uint32_t rung = 0;          ///< … of this level; 0: the mesh itself
    uint32_t soup = kNone;      ///< … or this soup, in the hierarchy's frame
    uint32_t carriage = kNone;  ///< into Draft::carriages; kNone: its parent's frame is its own
    uint32_t object = kNoObject;
    uint32_t level = 0;
    bool is_turning = false;  ///< a leaf while it turns, another one is while it glides (stays.h)
    data::MotionClass motion_class = data::MotionClass::kStatic;

    double size_m() const { return glm::length(box_max - box_min); }
};

/// A mesh reduced for one level; geometry kNoGeometry: no better than a finer rung.
struct MeshRung {
    uint32_t level = 0;
    double error_m = 0.0;
    FaceSoup soup;
    uint32_t geometry = kNoGeometry;
};

struct DraftMesh {
    FaceSoup soup;
    std::vector<MeshRung> rungs;  ///< levels rise; made when they are needed
    uint32_t geometry = kNoGeometry;
    glm::dvec3 box_min{0.0}, box_max{0.0};
};

struct Draft {
    const data::TimedScene& scene;
    BuildOptions options;
    double size_m = 0.0;  ///< W
    std::vector<DraftCluster> clusters;
    std::vector<DraftMesh> meshes;  ///< [scene.meshes]
    std::vector<FaceSoup> soups;    ///< emptied when a parent has taken them in
    std::vector<StepFunction> functions;
    std::vector<data::IndexRange> motions;  ///< distinct ones, into scene.keys
    std::vector<Carriage> carriages;
    GeometryPool pool;
    BuildCounts counts;

    LevelThresholds at(uint32_t level) const { return thresholds_at(options, level, size_m); }
};

/// Meshes, leaves (the first clusters, objects in order), distinct visibilities and motions; no level is decided.
Draft make_draft(const data::TimedScene& scene, const BuildOptions& options);

/// The most reduced rung a mesh has for a level, null when only the mesh itself will do.
const MeshRung* rung_at(const DraftMesh& mesh, uint32_t level);

struct Box {
    glm::dvec3 low{0.0}, high{0.0};
};

/// Holds everything below a cluster that is carried, in its carrier's frame, at every time it is there.
Box carried_box(const DraftCluster& cluster, const Carriage& carriage);

/// Makes rungs of one level for some meshes, on all threads.
/// @param meshes  distinct
void make_rungs(Draft& draft, std::span<const uint32_t> meshes, uint32_t level);

/// The soup that stands for a cluster, appended to `out`: of a mesh the coarsest rung that is off by no more than
/// `most_m`.
/// @param place  of the cluster's frame where `out` is
/// @returns how much more than the cluster's error_m it is off, metres; may be negative
double append_cluster_soup(const Draft& draft, const DraftCluster& cluster, double most_m,
                           const FramePlace& place, FaceSoup& out);

}  // namespace objects
