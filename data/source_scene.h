// SourceScene: what readers of models, footprints and cities hand over before a schedule gives it time.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "data/polygon_mesh.h"
#include "data/schedule_csv.h"
#include "data/timed_scene.h"
#include "lod/base/result.h"

namespace data {

/// An object as its source has it; events and key frames where the source knows of them (FBX).
struct SourceObject {
    std::string id;
    uint32_t mesh = 0;
    std::vector<VisibilityStep> events;
    std::vector<KeyFrame> keys;  ///< at least one: where it stands
};

struct SourceScene {
    std::vector<TimedMesh> meshes;
    std::vector<SourceObject> objects;
    double end_s = 0.0;  ///< 0: the source does not say
    glm::dvec3 origin_site{0.0};
    bool is_on_earth = false;
};

/// Ids, none given out twice: of equal names the second becomes "name#2".
class UniqueIds {
  public:
    /// @param name    blanks at its ends do not count; without any other letter it becomes "node-NUMBER"
    std::string take(const std::string& name, size_t number);

  private:
    std::set<std::string> used_;
};

/// A rigid placement and what is left of a transform: model_from_node = rigid * rest. `rest` is the identity, exactly,
/// where the transform is rigid but for rounding.
struct SplitTransform {
    KeyFrame pose;  ///< time 0
    glm::dmat3 rest{1.0};
};
SplitTransform split_transform(const glm::dmat4& model_from_node);

/// Moves, scales, shears or mirrors a mesh: p -> matrix * p.
TimedMesh transformed(const TimedMesh& mesh, const glm::dmat4& matrix);

/// The nodes of a model as objects, in the file's order; scale and shear worked into the meshes, equal meshes shared.
/// Nodes without triangles are left out unless the schedule names them. Nodes without a name get "node-N", and of equal names
/// the second "name#2", N from 1.
SourceScene objects_of_model(const SharedModel& model, const Schedule& schedule);

/// All of a model as one mesh, model frame.
TimedMesh mesh_of_model(const SharedModel& model);

/// A source and its schedule as a scene. Events of a schedule replace those of the source, key frames as well. An entry
/// with a model becomes an object of its own, one mesh for each file.
/// @param schedule_path  models are named relative to it
/// Fails naming the schedule's line when an id is not in the source, and as append_object does.
lod::Result<TimedScene> schedule_scene(SourceScene source, const Schedule& schedule,
                                       const std::string& schedule_path);

}  // namespace data
