#include "data/texture_baking.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "data/mesh_materials.h"

namespace data {

namespace {

float linear_from_srgb(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

std::array<float, 256> linear_table() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i)
        table[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
    return table;
}

int wrap(int i, int size) {
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

uint8_t byte_of(float value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

bool is_usable(const glm::vec2& uv) {
    return std::abs(uv.x) < 1e6f && std::abs(uv.y) < 1e6f;
}

/// Sums of samples at the vertices, weighted by texel area.
struct Sums {
    std::vector<glm::vec4> colour;
    std::vector<float> weight;
};

/// One sample for each corner: in the third of the triangle that is nearest to it, never outside.
void add_triangle(const WeldedCorners& mesh, const std::array<uint32_t, 3>& triangle,
                  const TexturePyramid& pyramid, Sums& sums) {
    const glm::vec2 uv[3] = {mesh.vertices.uvs[triangle[0]], mesh.vertices.uvs[triangle[1]],
                             mesh.vertices.uvs[triangle[2]]};
    if (!is_usable(uv[0]) || !is_usable(uv[1]) || !is_usable(uv[2])) return;
    const glm::vec2 a = (uv[1] - uv[0]) * pyramid.size_px(), b = (uv[2] - uv[0]) * pyramid.size_px();
    const float area_px2 = 0.5f * std::abs(a.x * b.y - a.y * b.x);
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec2 at = (4.0f * uv[i] + uv[(i + 1) % 3] + uv[(i + 2) % 3]) / 6.0f;
        const float weight = area_px2 + 1e-3f;
        sums.colour[triangle[i]] += weight * pyramid.sample(at, std::sqrt(area_px2 / 3.0f));
        sums.weight[triangle[i]] += weight;
    }
}

glm::vec4 straight_srgb(const glm::vec4& premultiplied) {
    if (premultiplied.w <= 0.0f) return glm::vec4(0.0f);
    const glm::vec3 linear = glm::vec3(premultiplied) / premultiplied.w;
    return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z),
            premultiplied.w};
}

}  // namespace

TexturePyramid::TexturePyramid(const MeshTexture& texture) {
    const std::array<float, 256> linear = linear_table();
    Level full{texture.width, texture.height, {}};
    full.texels.resize(static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height));
    for (size_t i = 0; i < full.texels.size(); ++i) {
        const uint8_t* texel = &texture.rgba[4 * i];
        const float opacity = static_cast<float>(texel[3]) / 255.0f;
        const glm::vec3 light(linear[texel[0]], linear[texel[1]], linear[texel[2]]);
        full.texels[i] = glm::u16vec4(glm::vec4(light * opacity, opacity) * 65535.0f + 0.5f);
    }
    levels_.push_back(std::move(full));
    while (std::max(levels_.back().width, levels_.back().height) > 1)
        levels_.push_back(half_of(levels_.back()));
}

TexturePyramid::Level TexturePyramid::half_of(const Level& level) {
    Level half{(level.width + 1) / 2, (level.height + 1) / 2, {}};
    for (int row = 0; row < half.height; ++row) {
        for (int col = 0; col < half.width; ++col) {
            const int right = std::min(2 * col + 1, level.width - 1),
                      above = std::min(2 * row + 1, level.height - 1);
            const auto texel = [&](int c, int r) {
                return glm::uvec4(level.texels[static_cast<size_t>(r * level.width + c)]);
            };
            const glm::uvec4 sum =
                texel(2 * col, 2 * row) + texel(right, 2 * row) + texel(2 * col, above) + texel(right, above);
            half.texels.push_back(glm::u16vec4((sum + 2u) / 4u));
        }
    }
    return half;
}

glm::vec4 TexturePyramid::sample(const glm::vec2& uv, float size_px) const {
    const float wanted = std::log2(std::max(size_px, 1.0f));
    const size_t at_level = std::min(static_cast<size_t>(wanted), levels_.size() - 1);
    const Level& level = levels_[at_level];
    const glm::vec2 at = uv * glm::vec2(level.width, level.height) - 0.5f;
    const glm::vec2 low = glm::floor(at), part = at - low;
    const auto texel = [&](int right, int above) {
        const int col = wrap(static_cast<int>(low.x) + right, level.width);
        const int row = wrap(static_cast<int>(low.y) + above, level.height);
        return glm::vec4(level.texels[static_cast<size_t>(row * level.width + col)]) / 65535.0f;
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x), glm::mix(texel(0, 1), texel(1, 1), part.x),
                    part.y);
}

std::vector<glm::u8vec4> bake_colours(const WeldedCorners& mesh, const BakingMaterials& baking) {
    const size_t count = mesh.vertices.positions.size();
    Sums sums{std::vector<glm::vec4>(count, glm::vec4(0.0f)), std::vector<float>(count, 0.0f)};
    for (const std::array<uint32_t, 3>& triangle : mesh.triangles) {
        const int32_t texture = baking.texture[mesh.vertices.materials[triangle[0]]];
        if (texture < 0) continue;
        add_triangle(mesh, triangle, baking.pyramids[static_cast<size_t>(texture)], sums);
    }
    std::vector<glm::u8vec4> colours(count);
    for (size_t i = 0; i < count; ++i) {
        glm::vec4 colour = mesh.vertices.tints[i];
        if (sums.weight[i] > 0.0f) {
            glm::vec4 texture = straight_srgb(sums.colour[i] / sums.weight[i]);
            if (baking.is_opaque[mesh.vertices.materials[i]]) texture.w = 1.0f;
            colour *= texture;
        }
        colours[i] = {byte_of(colour.x), byte_of(colour.y), byte_of(colour.z), byte_of(colour.w)};
    }
    return colours;
}

}  // namespace data
