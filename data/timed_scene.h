// TimedScene: objects over shared geometry that appear, disappear and move on a known schedule, from 0 to end_s.
//
// What generators and importers make and what objects/ builds its hierarchy from. Any polygon soup. An object is
// static (always there, never moves), pseudo-dynamic (comes and goes, never moves) or dynamic (moves).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace data {

/// Geometry that any number of objects share.
struct TimedMesh {
    std::vector<glm::vec3> positions;                ///< [vertices], object frame, metres, finite
    std::vector<glm::vec3> normals;                  ///< [vertices], unit length
    std::vector<glm::u8vec4> colours;                ///< [vertices], sRGB; alpha 255 is opaque
    std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise outside; may be none
};

/// From `time_s` on, that instant included, the object is there, or not. Before its first step an object is the
/// opposite of that step. Never there: one step at 0 that hides it.
struct VisibilityStep {
    double time_s = 0.0;
    bool is_visible = true;
};

/// Where a moving object is at a time; between two frames positions are interpolated linearly, rotations along the
/// shorter arc; before the first and after the last the object rests.
struct KeyFrame {
    double time_s = 0.0;
    glm::dvec3 position{0.0};                 ///< scene frame, metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< scene from object, unit length
};

/// Half-open range of one of the scene's arrays.
struct IndexRange {
    uint32_t begin = 0, end = 0;

    uint32_t size() const { return end - begin; }
};

struct TimedObject {
    uint32_t mesh = 0;  ///< into TimedScene::meshes
    IndexRange steps;   ///< into TimedScene::steps, times strictly rising; empty: there for ever
    IndexRange keys;    ///< into TimedScene::keys, times strictly rising; never empty; one: it never moves
    std::string id;     ///< the schedule's name for it; unique in a scene, may be empty
};

enum class MotionClass : uint8_t { kStatic, kPseudoDynamic, kDynamic };

struct TimedScene {
    double end_s =
        0.0;  ///< T > 0. Times are clamped to [0, T] when a scene is asked: what happens before 0 has
              ///< happened at 0, what happens after T never does (data/scene_time.h)
    glm::dvec3 origin_site{
        0.0};  ///< scene frame's origin: lon, lat in degrees and height m, or CRS x, y, height
    bool is_on_earth = false;  ///< false: the scene frame stands wherever it is put; +x east, +y north, +z up
    std::vector<TimedMesh> meshes;
    std::vector<TimedObject> objects;
    std::vector<VisibilityStep> steps;
    std::vector<KeyFrame> keys;
};

}  // namespace data
