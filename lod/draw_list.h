// What fronts hand to the renderer: vertices, indices, draw items and instances, as plain bytes and ranges.
//
// One vertex format and one instance record serve terrain, buildings, instruments and sky; GLSL reads the same
// layout (render/shaders), every offset is asserted below. Positions are the sum of two floats, so a vertex in
// ECEF keeps 0.1 um and the difference to the eye is exact where it matters (docs/decisions/0002).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace lod {

/// Whose triangles they are; also the `module` of an exported PLY.
enum class Module : uint8_t { kTerrain = 0, kObjects = 1, kInstruments = 2, kSky = 3 };

/// How a surface is shaded; lives in Vertex::colour[3].
enum class Material : uint8_t {
    kGround = 0,    ///< colour from the ground texture at the sample
    kWall = 1,      ///< building wall: lit, faint storey lines from height above its base
    kRoof = 2,      ///< building roof: lit
    kPaint = 3,     ///< plain lit surface (models, instrument bodies)
    kGlow = 4,      ///< not lit: lamps, self-luminous digits
    kGlass = 5,     ///< a faint reflection over what is behind; drawn last
    kSky = 6,       ///< position_hi.xy in clip space, at infinity
    kWallFoot = 7,  ///< foot of a wall: lowered by the ground's error of this frame so that no gap opens
    kAllRound =
        8,  ///< stands for many surfaces, upright all round and some that look up: their mean light from the eye
};

/// 32 bytes. `position_hi + position_lo` is the position in the instance's model frame, metres.
struct Vertex {
    float position_hi[3];
    float position_lo[3];
    uint16_t surface
        [2];  ///< kGround: sample (set_ground_sample); kAllRound: share that looks up, unorm16; else the normal, octahedral, snorm16 (bit-cast)
    uint8_t colour[4];  ///< sRGB red, green, blue; Material
};
static_assert(sizeof(Vertex) == 32 && offsetof(Vertex, position_lo) == 12 &&
              offsetof(Vertex, surface) == 24 && offsetof(Vertex, colour) == 28);

/// 112 bytes. position_eye = eye_from_model * ((hi - origin_hi) + (lo - origin_lo)).
struct Instance {
    float eye_from_model[3][4];  ///< rows of rotation times scale; 4th column unused
    float origin_hi[4];          ///< the eye in the model frame: high parts, w unused
    float origin_lo[4];          ///< … and low parts
    float up_eye[4];             ///< local vertical in the eye frame; w: ground error in px for kWallFoot
    uint32_t is_world = 1;       ///< 1: the model frame is the world frame
    uint32_t module = 0;         ///< Module
    uint32_t unused[2] = {0, 0};
};
static_assert(sizeof(Instance) == 112 && offsetof(Instance, origin_hi) == 48 &&
              offsetof(Instance, up_eye) == 80 && offsetof(Instance, is_world) == 96);

/// One command of the frame's only draw: `index_count` indices from `first_index` of the pool, each plus
/// `base_vertex`.
struct DrawItem {
    uint32_t index_count = 0;
    uint32_t first_index = 0;
    int32_t base_vertex = 0;
    uint32_t instance = 0;  ///< into DrawList::instances
    bool is_glass = false;  ///< drawn after everything else, the last of them first
};

/// Bytes to place into the geometry pool before the draw. The data must stay valid until the next emit.
struct VertexWrite {
    uint32_t first_vertex = 0;
    std::span<const Vertex> vertices;
};
struct IndexWrite {
    uint32_t first_index = 0;
    std::span<const uint32_t> indices;
};

/// A front's own part of the geometry pool.
struct PoolRegion {
    uint32_t first_vertex = 0, vertex_capacity = 0;
    uint32_t first_index = 0, index_capacity = 0;
};

/// Everything one view draws. Cleared and refilled each frame; capacity is kept.
struct DrawList {
    std::vector<DrawItem> items;
    std::vector<Instance> instances;
    std::vector<VertexWrite> vertex_writes;
    std::vector<IndexWrite> index_writes;

    void clear() {
        items.clear();
        instances.clear();
        vertex_writes.clear();
        index_writes.clear();
    }
};

/// The vertex with this position (split into two floats), normal and colour.
/// @param normal  unit length, model frame
Vertex make_vertex(const glm::dvec3& position, const glm::vec3& normal, const glm::u8vec3& colour,
                   Material material);

/// … that stands for surfaces all round.
/// @param up_share  of them, looks up, 0 … 1
Vertex make_all_round_vertex(const glm::dvec3& position, double up_share, const glm::u8vec3& colour);

/// Makes a vertex one of the ground that lies on a sample, column and row below 2^24. What `surface` cannot hold stands in
/// `colour`, counted down from white.
inline void set_ground_sample(Vertex& v, int col, int row) {
    v.surface[0] = static_cast<uint16_t>(col & 0xffff);
    v.surface[1] = static_cast<uint16_t>(row & 0xffff);
    v.colour[0] = static_cast<uint8_t>(255 - (col >> 16));
    v.colour[1] = static_cast<uint8_t>(255 - (row >> 16));
    v.colour[2] = 255;
    v.colour[3] = static_cast<uint8_t>(Material::kGround);
}
/// Column and row of a vertex of the ground.
inline glm::ivec2 ground_sample(const Vertex& v) {
    return {v.surface[0] | (255 - v.colour[0]) << 16, v.surface[1] | (255 - v.colour[1]) << 16};
}

/// Splits each coordinate so that hi + lo equals it within 2^-48 relative.
void split_hi_lo(const glm::dvec3& value, float hi[3], float lo[3]);

/// position_hi + position_lo, exact.
inline glm::dvec3 position_of(const Vertex& v) {
    return {double(v.position_hi[0]) + double(v.position_lo[0]),
            double(v.position_hi[1]) + double(v.position_lo[1]),
            double(v.position_hi[2]) + double(v.position_lo[2])};
}

/// Unit vector to two snorm16 on the octahedron, and back; the angle between is below 0.01 degrees.
/// Source: Cigolle et al., Survey of efficient representations for independent unit vectors (2014).
void encode_normal(const glm::vec3& normal, uint16_t out[2]);
glm::vec3 decode_normal(const uint16_t in[2]);

/// The instance record of a model that stands at `origin_world` with the axes `world_from_model` (rotation times
/// uniform scale), seen by an eye.
Instance make_instance(const glm::dvec3& eye_world, const glm::dmat3& eye_from_world,
                       const glm::dvec3& origin_world, const glm::dmat3& world_from_model, Module module);

/// The instance record of geometry whose model frame is the world itself.
Instance make_world_instance(const glm::dvec3& eye_world, const glm::dmat3& eye_from_world, Module module);

}  // namespace lod
