// Materials and textures of a model, from Assimp's.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "data/polygon_mesh.h"

namespace data {

/// What the corners of a mesh need beside MeshMaterial.
struct MaterialUse {
    unsigned uv_channel = 0;  ///< Assimp's, for the colour texture
    bool is_opaque = false;   ///< glTF: alpha of texture and vertices is to be ignored
};

struct MaterialSet {
    std::vector<MeshMaterial> materials;        ///< [scene.mNumMaterials]
    std::vector<MaterialUse> uses;              ///< the same
    std::vector<MeshTexture> textures;          ///< each image once
    std::vector<std::string> missing_textures;  ///< images that are named and cannot be read
};

/// @param model_path  textures are looked for relative to it, then by their plain name beside it
/// @param is_linear   the file's colours are linear, as glTF's are; they become sRGB
MaterialSet read_materials(const aiScene& scene, const std::string& model_path, bool is_linear);

/// sRGB of a linear value, [0, 1] to [0, 1]; values outside are clamped.
float srgb_from_linear(float linear);

}  // namespace data
