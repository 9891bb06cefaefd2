#include "data/model_source.h"

#include <assimp/config.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "data/ac3d_places.h"
#include "data/file_bytes.h"
#include "data/model_truncation.h"

namespace data {

namespace {

constexpr size_t kMaxSize_bytes = size_t{4} << 30;

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    for (char& letter : extension)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return extension;
}

bool is_finite(const aiVector3D& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::optional<std::string> mesh_problem(const aiMesh& mesh) {
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        if (!is_finite(mesh.mVertices[i]))
            return "a vertex has coordinates that are no numbers; expected finite ones";
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
            if (face.mIndices[corner] >= mesh.mNumVertices)
                return "a face names a vertex that is not there; expected one of " +
                       std::to_string(mesh.mNumVertices);
        }
    }
    return std::nullopt;
}

std::optional<std::string> node_problem(const aiScene& scene, const aiNode& node) {
    for (unsigned row = 0; row < 4; ++row) {
        for (unsigned col = 0; col < 4; ++col) {
            if (!std::isfinite(node.mTransformation[row][col]))
                return "a node's transform is not finite; expected numbers";
        }
    }
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= scene.mNumMeshes)
            return "a node names a mesh that is not there; expected one of " +
                   std::to_string(scene.mNumMeshes);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        if (std::optional<std::string> problem = node_problem(scene, *node.mChildren[i])) return problem;
    }
    return std::nullopt;
}

std::optional<std::string> scene_problem(const aiScene& scene) {
    if (scene.mRootNode == nullptr) return "no nodes; expected a polygon model";
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        if (std::optional<std::string> problem = mesh_problem(*scene.mMeshes[i])) return problem;
        if (scene.mMeshes[i]->mMaterialIndex >= scene.mNumMaterials)
            return "a mesh names a material that is not there; expected one of the file";
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

/// Sets which kinds of faces each mesh has. Assimp takes faces without corners for polygons, and ends the program
/// when it then finds nothing to triangulate.
void correct_face_kinds(const aiScene& scene) {
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        aiMesh& mesh = *scene.mMeshes[i];
        mesh.mPrimitiveTypes = aiPrimitiveType_POINT;  // 0 would make Assimp look for itself
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const unsigned corners = mesh.mFaces[f].mNumIndices;
            if (corners == 2) mesh.mPrimitiveTypes |= aiPrimitiveType_LINE;
            if (corners == 3) mesh.mPrimitiveTypes |= aiPrimitiveType_TRIANGLE;
            if (corners > 3) mesh.mPrimitiveTypes |= aiPrimitiveType_POLYGON;
        }
    }
}

/// Material files that an OBJ names and that are not beside it; Assimp also tries the model's own name.
std::vector<std::string> missing_libraries(std::string_view content, const std::filesystem::path& path) {
    constexpr std::string_view kWord = "mtllib ";
    std::vector<std::string> missing;
    std::error_code failure;
    const auto is_there = [&](const std::filesystem::path& file) {
        return std::filesystem::is_regular_file(file, failure);
    };
    if (is_there(std::filesystem::path(path).replace_extension(".mtl"))) return missing;
    while (!content.empty()) {
        std::string_view line = content.substr(0, content.find_first_of("\r\n"));
        content.remove_prefix(std::min(line.size() + 1, content.size()));
        if (line.substr(0, kWord.size()) != kWord) continue;
        line.remove_prefix(std::min(line.find_first_not_of(' ', kWord.size()), line.size()));
        line = line.substr(0, line.find_last_not_of(" \t") + 1);
        if (!is_there(path.parent_path() / line)) missing.emplace_back(line);
    }
    return missing;
}

size_t count_nodes(const aiNode& node) {
    size_t count = 1;
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        count += count_nodes(*node.mChildren[i]);
    return count;
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

    const lod::Result<std::vector<uint8_t>> content =
        is_packed ? read_gzip_file(path, kMaxSize_bytes) : read_file(path, kMaxSize_bytes);
    if (!content) return content.error();
    const std::string_view text(reinterpret_cast<const char*>(content->data()), content->size());
    if (const std::optional<std::string> problem = truncation_problem(text, model.extension))
        return lod::Error{path + ": " + *problem};

    model.importer = std::make_unique<Assimp::Importer>();
    const lod::Result<const aiScene*> scene =
        import(*model.importer, path, is_packed ? &*content : nullptr, model.extension);
    if (!scene)
        return lod::Error{path + ": cannot read the model: " + one_line(scene.message()) +
                          "; expected a whole file in a format that Assimp reads"};
    model.scene = *scene;
    if (const std::optional<std::string> problem = scene_problem(*model.scene))
        return lod::Error{path + ": " + *problem};
    correct_face_kinds(*model.scene);
    if (is_ac3d(model.extension)) model.node_shifts = ac3d_places(text);
    if (model.extension == "obj") model.missing_libraries = missing_libraries(text, path);
    if (model.node_shifts.size() != count_nodes(*model.scene->mRootNode)) model.node_shifts.clear();
    return model;
}

}  // namespace data
