#include "lod/draw_list.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lod {

namespace {

struct HiLo {
    float hi, lo;
};

/// Not inlined: g++ 12.2 at -O3 packs neighbouring axes into one vector, takes double(float(x)) for x and stores
/// zeros for the low parts (draw_list_test).
[[gnu::noinline]] HiLo split(double value) {
    const float hi = static_cast<float>(value);
    return {hi, static_cast<float>(value - static_cast<double>(hi))};
}

}  // namespace

void split_hi_lo(const glm::dvec3& value, float hi[3], float lo[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const HiLo parts = split(value[axis]);
        hi[axis] = parts.hi;
        lo[axis] = parts.lo;
    }
}

void encode_normal(const glm::vec3& normal, uint16_t out[2]) {
    const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    float u = sum > 0.0f ? normal.x / sum : 0.0f, v = sum > 0.0f ? normal.y / sum : 0.0f;
    if (normal.z < 0.0f) {
        const float folded = (1.0f - std::abs(v)) * (u < 0.0f ? -1.0f : 1.0f);
        v = (1.0f - std::abs(u)) * (v < 0.0f ? -1.0f : 1.0f);
        u = folded;
    }
    out[0] = std::bit_cast<uint16_t>(static_cast<int16_t>(std::lround(u * 32767.0f)));
    out[1] = std::bit_cast<uint16_t>(static_cast<int16_t>(std::lround(v * 32767.0f)));
}

glm::vec3 decode_normal(const uint16_t in[2]) {
    const float u = static_cast<float>(std::bit_cast<int16_t>(in[0])) / 32767.0f;
    const float v = static_cast<float>(std::bit_cast<int16_t>(in[1])) / 32767.0f;
    glm::vec3 n(u, v, 1.0f - std::abs(u) - std::abs(v));
    if (n.z < 0.0f) {
        n.x = (1.0f - std::abs(v)) * (u < 0.0f ? -1.0f : 1.0f);
        n.y = (1.0f - std::abs(u)) * (v < 0.0f ? -1.0f : 1.0f);
    }
    return glm::normalize(n);
}

Vertex make_vertex(const glm::dvec3& position, const glm::vec3& normal, const glm::u8vec3& colour,
                   Material material) {
    Vertex vertex;
    split_hi_lo(position, vertex.position_hi, vertex.position_lo);
    encode_normal(normal, vertex.surface);
    vertex.colour[0] = colour.x;
    vertex.colour[1] = colour.y;
    vertex.colour[2] = colour.z;
    vertex.colour[3] = static_cast<uint8_t>(material);
    return vertex;
}

Vertex make_all_round_vertex(const glm::dvec3& position, double up_share, const glm::u8vec3& colour) {
    Vertex vertex = make_vertex(position, {0.0f, 0.0f, 1.0f}, colour, Material::kAllRound);
    vertex.surface[0] = static_cast<uint16_t>(std::lround(65535.0 * std::clamp(up_share, 0.0, 1.0)));
    vertex.surface[1] = 0;
    return vertex;
}

Instance make_instance(const glm::dvec3& eye_world, const glm::dmat3& eye_from_world,
                       const glm::dvec3& origin_world, const glm::dmat3& world_from_model, Module module) {
    Instance instance{};
    const glm::dmat3 eye_from_model = eye_from_world * world_from_model;
    for (int row = 0; row < 3; ++row) {
        for (int col = 0; col < 3; ++col) {
            instance.eye_from_model[row][col] = static_cast<float>(eye_from_model[col][row]);
        }
    }
    const glm::dvec3 eye_model = glm::inverse(world_from_model) * (eye_world - origin_world);
    split_hi_lo(eye_model, instance.origin_hi, instance.origin_lo);
    instance.is_world = 0;
    instance.module = static_cast<uint32_t>(module);
    return instance;
}

Instance make_world_instance(const glm::dvec3& eye_world, const glm::dmat3& eye_from_world, Module module) {
    Instance instance = make_instance(eye_world, eye_from_world, glm::dvec3(0.0), glm::dmat3(1.0), module);
    instance.is_world = 1;
    return instance;
}

}  // namespace lod
