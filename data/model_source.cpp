#include "data/model_source.h"

#include <assimp/config.h>

#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <vector>

#include "data/gzip_file.h"

namespace data {

namespace {

constexpr size_t kMaxUnpacked_bytes = size_t{4} << 30;
constexpr size_t kHead_bytes = 84;

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    for (char& letter : extension)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return extension;
}

uint32_t little_endian(const std::vector<uint8_t>& head, size_t at) {
    return static_cast<uint32_t>(head[at] | head[at + 1] << 8 | head[at + 2] << 16) |
           static_cast<uint32_t>(head[at + 3]) << 24;
}

/// Formats that state their length are held to it, before anything trusts their counts.
/// @param size_bytes  of the whole content that `head` begins
std::optional<std::string> length_problem(const std::vector<uint8_t>& head, uintmax_t size_bytes,
                                          const std::string& extension) {
    if (size_bytes == 0) return "empty file";
    if (extension == "glb") {
        if (head.size() < 20 || std::memcmp(head.data(), "glTF", 4) != 0) return "not a binary glTF";
        if (little_endian(head, 8) > size_bytes) return "truncated: shorter than its header says";
    }
    if (extension == "stl" && (head.size() < 5 || std::memcmp(head.data(), "solid", 5) != 0)) {
        if (head.size() < kHead_bytes) return "truncated: shorter than a binary STL's header";
        if (kHead_bytes + 50u * static_cast<uintmax_t>(little_endian(head, 80)) > size_bytes)
            return "truncated: fewer facets than its header says";
    }
    return std::nullopt;
}

bool is_finite(const aiVector3D& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::optional<std::string> mesh_problem(const aiMesh& mesh) {
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        if (!is_finite(mesh.mVertices[i])) return "a vertex has coordinates that are not finite numbers";
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
            if (face.mIndices[corner] >= mesh.mNumVertices) return "a face names a vertex that is not there";
        }
    }
    return std::nullopt;
}

std::optional<std::string> node_problem(const aiScene& scene, const aiNode& node) {
    for (unsigned row = 0; row < 4; ++row) {
        for (unsigned col = 0; col < 4; ++col) {
            if (!std::isfinite(node.mTransformation[row][col])) return "a node's transform is not finite";
        }
    }
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= scene.mNumMeshes) return "a node names a mesh that is not there";
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        if (std::optional<std::string> problem = node_problem(scene, *node.mChildren[i])) return problem;
    }
    return std::nullopt;
}

std::optional<std::string> scene_problem(const aiScene& scene) {
    if (scene.mRootNode == nullptr) return "no nodes";
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        if (std::optional<std::string> problem = mesh_problem(*scene.mMeshes[i])) return problem;
        if (scene.mMeshes[i]->mMaterialIndex >= scene.mNumMaterials)
            return "a mesh names a material that is not there";
    }
    return node_problem(scene, *scene.mRootNode);
}

/// Assimp's answer or its complaint; it throws on some broken files.
lod::Result<const aiScene*> import(Assimp::Importer& importer, const std::string& path,
                                   const std::vector<uint8_t>* unpacked, const std::string& extension) {
    importer.SetPropertyBool(AI_CONFIG_IMPORT_AC_SEPARATE_BFCULL, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_AC_EVAL_SUBDIVISION, false);
    try {
        const aiScene* scene =
            unpacked == nullptr
                ? importer.ReadFile(path, 0)
                : importer.ReadFileFromMemory(unpacked->data(), unpacked->size(), 0, extension.c_str());
        if (scene != nullptr) return scene;
        return lod::Error{importer.GetErrorString()};
    } catch (const std::exception& problem) {
        return lod::Error{problem.what()};
    }
}

std::string one_line(std::string text) {
    for (char& letter : text)
        letter = letter == '\n' || letter == '\r' ? ' ' : letter;
    return text;
}

}  // namespace

lod::Result<ModelSource> open_model(const std::string& path) {
    const bool is_packed = lower_extension(path) == "gz";
    ModelSource model;
    model.extension =
        lower_extension(is_packed ? std::filesystem::path(path).stem() : std::filesystem::path(path));

    lod::Result<std::vector<uint8_t>> head =
        is_packed ? read_gzip_file(path, kMaxUnpacked_bytes) : read_file_head(path, kHead_bytes);
    if (!head) return head.error();
    std::error_code failure;
    const uintmax_t size_bytes = is_packed ? head->size() : std::filesystem::file_size(path, failure);
    if (const std::optional<std::string> problem = length_problem(*head, size_bytes, model.extension))
        return lod::Error{path + ": " + *problem};

    model.importer = std::make_unique<Assimp::Importer>();
    const lod::Result<const aiScene*> scene =
        import(*model.importer, path, is_packed ? &*head : nullptr, model.extension);
    if (!scene) return lod::Error{path + ": cannot read the model: " + one_line(scene.message())};
    model.scene = *scene;
    if (const std::optional<std::string> problem = scene_problem(*model.scene))
        return lod::Error{path + ": " + *problem};
    return model;
}

}  // namespace data
