// Textures into vertex colours: each vertex takes the mean of the texture over the parts of its triangles near it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "data/mesh_corners.h"
#include "data/polygon_mesh.h"

namespace data {

/// A texture at full, half, quarter, .. size, in linear light with opacity multiplied in, so that means are right.
class TexturePyramid {
  public:
    explicit TexturePyramid(const MeshTexture& texture);

    /// Texels of the full image.
    glm::vec2 size_px() const { return {levels_[0].width, levels_[0].height}; }

    /// Mean around `uv` over about size_px texels of the full image; the image repeats. Linear, premultiplied.
    glm::vec4 sample(const glm::vec2& uv, float size_px) const;

  private:
    struct Level {
        int width = 0, height = 0;
        std::vector<glm::u16vec4> texels;  ///< 65535 is 1
    };
    static Level half_of(const Level& level);
    std::vector<Level> levels_;
};

/// What baking knows of the materials.
struct BakingMaterials {
    std::vector<int32_t> texture;          ///< [materials] into pyramids; -1: the tint alone
    std::vector<bool> is_opaque;           ///< [materials] the texture's opacity does not count
    std::vector<TexturePyramid> pyramids;  ///< [textures]
};

/// Final colours of welded vertices: tint times texture, sRGB and opacity.
std::vector<glm::u8vec4> bake_colours(const WeldedCorners& mesh, const BakingMaterials& baking);

}  // namespace data
