#include "data/mesh_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "data/texture_image.h"

namespace data {

namespace {

namespace fs = std::filesystem;

float unit(float value) {
    return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.0f;
}

/// Pixels that lie raw in the scene, top row first.
MeshTexture raw_texture(const aiTexture& source) {
    MeshTexture texture;
    texture.width = static_cast<int>(source.mWidth);
    texture.height = static_cast<int>(source.mHeight);
    for (unsigned row = source.mHeight; row-- > 0;) {
        for (unsigned col = 0; col < source.mWidth; ++col) {
            const aiTexel& texel = source.pcData[size_t{row} * source.mWidth + col];
            texture.rgba.insert(texture.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
        }
    }
    return texture;
}

std::optional<MeshTexture> embedded_texture(const aiTexture& source) {
    if (source.pcData == nullptr) return std::nullopt;
    if (source.mHeight > 0) return raw_texture(source);
    return decode_texture(std::span(reinterpret_cast<const uint8_t*>(source.pcData), source.mWidth));
}

std::optional<MeshTexture> neighbour_texture(std::string name, const std::string& model_path) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path folder = fs::path(model_path).parent_path();
    if (std::optional<MeshTexture> texture = read_texture((folder / name).string())) return texture;
    return read_texture((folder / fs::path(name).filename()).string());
}

/// Every image once, found by the name materials use for it.
class TextureShelf {
  public:
    TextureShelf(const aiScene& scene, const std::string& model_path, MaterialSet& out)
        : scene_(scene), model_path_(model_path), out_(out) {}

    /// @returns index into the set's textures, -1 when it cannot be read
    int32_t index_of(const std::string& name) {
        const auto known = by_name_.find(name);
        if (known != by_name_.end()) return known->second;
        const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str());
        std::optional<MeshTexture> texture =
            inside != nullptr ? embedded_texture(*inside) : neighbour_texture(name, model_path_);
        int32_t index = -1;
        if (texture) {
            index = static_cast<int32_t>(out_.textures.size());
            out_.textures.push_back(std::move(*texture));
        } else {
            out_.missing_textures.push_back(name);
        }
        by_name_.emplace(name, index);
        return index;
    }

  private:
    const aiScene& scene_;
    const std::string& model_path_;
    MaterialSet& out_;
    std::map<std::string, int32_t> by_name_;
};

glm::vec4 base_colour(const aiMaterial& source, bool is_linear) {
    aiColor4D colour(0.8f, 0.8f, 0.8f, 1.0f);
    if (source.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS)
        source.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    float opacity = colour.a;
    if (!is_linear) source.Get(AI_MATKEY_OPACITY, opacity);
    glm::vec4 result(unit(colour.r), unit(colour.g), unit(colour.b), unit(opacity));
    if (is_linear) {
        for (int part = 0; part < 3; ++part)
            result[part] = srgb_from_linear(result[part]);
    }
    return result;
}

/// The strongest channel; 0 where a texture says which parts glow, as colours per vertex cannot.
float emission(const aiMaterial& source) {
    aiColor3D emissive(0.0f, 0.0f, 0.0f);
    source.Get(AI_MATKEY_COLOR_EMISSIVE, emissive);
    if (source.GetTextureCount(aiTextureType_EMISSIVE) > 0) return 0.0f;
    return std::max({unit(emissive.r), unit(emissive.g), unit(emissive.b)});
}

}  // namespace

MaterialSet read_materials(const aiScene& scene, const std::string& model_path, bool is_linear) {
    MaterialSet set;
    TextureShelf shelf(scene, model_path, set);
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
        const aiMaterial& source = *scene.mMaterials[i];
        MeshMaterial material;
        MaterialUse use;
        material.name = source.GetName().C_Str();
        material.colour = base_colour(source, is_linear);
        material.emission = emission(source);
        aiString alpha_mode;
        if (source.Get(AI_MATKEY_GLTF_ALPHAMODE, alpha_mode) == aiReturn_SUCCESS)
            use.is_opaque = std::string_view(alpha_mode.C_Str()) == "OPAQUE";
        if (use.is_opaque) material.colour.w = 1.0f;
        for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
            aiString name;
            if (material.texture >= 0 || source.GetTextureCount(type) == 0) continue;
            if (source.GetTexture(type, 0, &name, nullptr, &use.uv_channel) != aiReturn_SUCCESS) continue;
            if (name.length > 0) material.texture = shelf.index_of(name.C_Str());
        }
        set.materials.push_back(std::move(material));
        set.uses.push_back(use);
    }
    return set;
}

float srgb_from_linear(float linear) {
    const float value = unit(linear);
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

}  // namespace data
