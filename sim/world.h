// World: everything a scene file names, read and ready to be drawn. A module the scene does not name has no front,
// no buffer and no cost.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "data/footprints.h"
#include "data/height_grid.h"
#include "data/image.h"
#include "lod/base/result.h"
#include "lod/rigid_front.h"
#include "objects/buildings.h"
#include "objects/cluster_front.h"
#include "render/renderer.h"
#include "sim/adaptive_models.h"
#include "sim/eyepoint.h"
#include "sim/model_pose.h"
#include "sim/relief_timeline.h"
#include "sim/scene_file.h"
#include "sim/signals.h"
#include "terrain/roam_front.h"

namespace sim {

struct WorldOptions {
    double tolerance_px = 1.0;
    /// Vertices take this long to their place; 0: they jump. Sooner than this, and a near place that comes into
    /// view would move by more than half a pixel a frame (tests/sim/popping_test.cpp).
    double glide_s = 0.6;
    int batch = 0;         ///< leaves of the terrain are drawn as 4^batch triangles; above 0 nothing glides
    unsigned threads = 2;  ///< for the error computation and the ground's colours; changes no result
    uint64_t reserve_triangles = 0;  ///< the terrain front allocates nothing below this many
    bool has_picture = true;         ///< false: nobody looks, the ground is not painted
    bool waits_for_pages = false;    ///< a paged terrain is drawn with all it wants, whatever that takes
    std::string trajectory;          ///< replaces the scene's path; empty: none
};

/// Instruments as they hang in the cockpit.
struct Cockpit {
    std::vector<MovingBody> moving;
    std::vector<lod::BodyPose>
        poses;  ///< [bodies], in the cockpit's frame, needles where the last signals put them
};

/// Buildings of one source that stand on ground that will change.
struct StandingBuildings {
    data::Footprints footprints;
    std::vector<objects::BuildingSite> sites;
    std::vector<data::SampleRange> ground;  ///< [sites]: what each stands on
    uint32_t first_part = 0;                ///< in the front of objects
    size_t first_base = 0;                  ///< in World::buildings
};

/// A model that stands on the ground.
struct StandingModel {
    ModelSource source;
    uint32_t body = 0;    ///< in the front of objects, or in World::models_rig.poses
    bool adapts = false;  ///< the latter
};

/// Move-only; fronts refer to the ground, which keeps its address.
struct World {
    Scene scene;
    data::WorldFrame frame;
    std::unique_ptr<data::HeightGrid> ground;  ///< null without [terrain], as all below
    int ground_stride =
        1;  ///< the drawn terrain has this many samples to one of `ground`'s (paged_terrain.h)
    std::unique_ptr<terrain::RoamFront> terrain;
    std::unique_ptr<lod::RigidFront> objects;
    std::vector<std::unique_ptr<objects::ClusterFront>> sites;  ///< of [[objects]], as the scene lists them
    std::unique_ptr<lod::MeshFront> models;                     ///< large ones, which adapt (world_models.h)
    AdaptiveRig models_rig;                                     ///< in the world
    std::unique_ptr<lod::RigidFront> instruments;
    Cockpit cockpit;
    std::unique_ptr<lod::MeshFront> panel;  ///< instruments that adapt
    AdaptiveRig panel_rig;                  ///< in the cockpit's frame
    Eyepoint eyepoint;
    data::Image ground_colours;  ///< empty without terrain or picture; not needed once a renderer has them
    ReliefTimeline relief;       ///< the scene's edits; none: nothing below is kept
    std::vector<StandingBuildings> standing_buildings;
    std::vector<StandingModel> standing_models;
    glm::dvec3 sun_world{0.0, 0.0, 1.0};
    std::vector<glm::dvec3> buildings;  ///< one corner of each building's base, world
    uint32_t item_count = 0;            ///< draw items of objects and instruments, at most
    std::vector<std::string> notes;     ///< liberties taken while reading
};

/// Reads and builds a scene; says on stderr what each long step found.
/// Fails on the first source that cannot be read, naming it.
lod::Result<std::unique_ptr<World>> build_world(const Scene& scene, const WorldOptions& options);

/// A front of the world and what it stands for.
struct WorldFront {
    lod::Front* front = nullptr;
    lod::Module module = lod::Module::kTerrain;
    bool adapts = false;            ///< false: what it draws is no matter of the budget
    bool follows_schedule = false;  ///< its time is the schedule's
};

/// The fronts there are, in the order of lod::Module.
std::vector<WorldFront> fronts_of(const World& world);

/// The ground, and all that rests on it, at a time: puts edits in force or takes them back. Where none is due, nothing
/// happens. @returns the edits that changed sides, in this order; the renderer has yet to get their colours
/// Cost: that of RoamFront::edit for each, and of the buildings over it.
std::vector<const TimedEdit*> bring_relief_to(World& world, double time_s);

/// What needles show at a state of flight.
Signals signals_of(const World& world, const EyeState& state, double time_s);

/// Height of the source ground at a site; 0 where there is none.
double ground_height_m(const World& world, const data::SitePoint& site);

}  // namespace sim
