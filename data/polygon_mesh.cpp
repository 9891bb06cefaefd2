#include "data/polygon_mesh.h"

#include <assimp/postprocess.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "data/ac3d_places.h"
#include "data/mesh_corners.h"
#include "data/mesh_materials.h"
#include "data/model_source.h"
#include "data/texture_baking.h"

namespace data {

namespace {

/// What is known of a format beyond what Assimp hands over.
struct FormatTraits {
    bool is_y_up = false;
    bool is_linear = false;          ///< colours are linear light
    bool has_facet_normals = false;  ///< normals say nothing the triangles do not
};

FormatTraits traits_of(const std::string& extension) {
    if (extension == "glb" || extension == "gltf") return {.is_y_up = true, .is_linear = true};
    if (is_ac3d(extension)) return {.is_y_up = true};
    if (extension == "stl") return {.has_facet_normals = true};
    return {};
}

/// Everything the nodes are read with.
struct MeshReader {
    const aiScene& scene;
    FormatTraits traits;
    const MaterialSet& materials;
    BakingMaterials baking;
    const std::vector<glm::dvec3>& node_shifts;  ///< ModelSource's
};

glm::dmat4 matrix_of(const aiMatrix4x4& rows) {
    glm::dmat4 matrix;
    for (unsigned row = 0; row < 4; ++row) {
        for (unsigned col = 0; col < 4; ++col)
            matrix[static_cast<int>(col)][static_cast<int>(row)] = static_cast<double>(rows[row][col]);
    }
    return matrix;
}

/// (x, y, z) -> (x, -z, y)
glm::dmat4 z_up_from_y_up() {
    return {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, -1.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
}

glm::vec3 vec_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

/// The file's normal on unit length; zero where it has none that is usable.
glm::vec3 normal_of(const aiMesh& mesh, unsigned vertex, const FormatTraits& traits) {
    if (traits.has_facet_normals || mesh.mNormals == nullptr) return glm::vec3(0.0f);
    const glm::vec3 normal = vec_of(mesh.mNormals[vertex]);
    const float length = glm::length(normal);
    return std::isfinite(length) && length > 1e-6f ? normal / length : glm::vec3(0.0f);
}

/// Material and vertex colour. glTF multiplies them; elsewhere vertex colours stand for the material's.
glm::vec4 tint_of(const MeshReader& reader, const aiMesh& mesh, unsigned vertex) {
    const glm::vec4 material = reader.materials.materials[mesh.mMaterialIndex].colour;
    if (mesh.mColors[0] == nullptr) return material;
    const aiColor4D& source = mesh.mColors[0][vertex];
    const bool is_opaque = reader.materials.uses[mesh.mMaterialIndex].is_opaque;
    glm::vec4 colour(source.r, source.g, source.b, is_opaque ? 1.0f : source.a);
    for (int part = 0; part < 4; ++part)
        colour[part] = std::isfinite(colour[part]) ? std::clamp(colour[part], 0.0f, 1.0f) : 1.0f;
    if (!reader.traits.is_linear) return {glm::vec3(colour), colour.w * material.w};
    for (int part = 0; part < 3; ++part)
        colour[part] = srgb_from_linear(colour[part]);
    return colour * material;
}

void append_corner(const MeshReader& reader, const aiMesh& mesh, unsigned vertex, MeshCorners& out) {
    const unsigned channel = reader.materials.uses[mesh.mMaterialIndex].uv_channel;
    const bool has_uv = channel < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(channel);
    glm::vec2 uv(0.0f);
    if (has_uv) uv = {mesh.mTextureCoords[channel][vertex].x, mesh.mTextureCoords[channel][vertex].y};
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = glm::vec2(0.0f);
    out.positions.push_back(vec_of(mesh.mVertices[vertex]));
    out.normals.push_back(normal_of(mesh, vertex, reader.traits));
    out.uvs.push_back(uv);
    out.tints.push_back(tint_of(reader, mesh, vertex));
    out.materials.push_back(mesh.mMaterialIndex);
}

/// All triangles of a node's meshes; those with two equal corners are counted and left out.
MeshCorners corners_of(const MeshReader& reader, const aiNode& node, bool& has_uvs, PolygonMeshStats& stats) {
    MeshCorners corners;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *reader.scene.mMeshes[node.mMeshes[i]];
        has_uvs |= mesh.HasTextureCoords(reader.materials.uses[mesh.mMaterialIndex].uv_channel);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) continue;  // points and lines
            const aiVector3D &a = mesh.mVertices[face.mIndices[0]], &b = mesh.mVertices[face.mIndices[1]],
                             &c = mesh.mVertices[face.mIndices[2]];
            if (a == b || b == c || c == a) {
                ++stats.dropped_faces;
                continue;
            }
            for (unsigned corner = 0; corner < 3; ++corner)
                append_corner(reader, mesh, face.mIndices[corner], corners);
        }
    }
    return corners;
}

/// Takes back what was added to the vertices, and puts it where it belongs.
void restore_place(const glm::dvec3& shift, MeshCorners& corners, MeshNode& node) {
    for (glm::vec3& position : corners.positions)
        position = glm::vec3(glm::dvec3(position) - shift);
    node.parent_from_node = glm::translate(glm::dmat4(1.0), shift) * node.parent_from_node;
}

/// @param index  of the node, depth first
MeshNode read_node(const MeshReader& reader, const aiNode& source, size_t index, PolygonMeshStats& stats) {
    MeshNode node;
    node.name = source.mName.C_Str();
    node.parent_from_node = matrix_of(source.mTransformation);
    if (source.mNumMeshes == 0) return node;
    bool has_uvs = false;
    MeshCorners corners = corners_of(reader, source, has_uvs, stats);
    if (source.mNumMeshes > 0 && index < reader.node_shifts.size())
        restore_place(reader.node_shifts[index], corners, node);
    make_smooth_normals(corners);
    WeldedCorners welded = weld(corners);
    node.colours = bake_colours(welded, reader.baking);
    for (const std::array<uint32_t, 3>& triangle : welded.triangles)
        node.triangle_material.push_back(welded.vertices.materials[triangle[0]]);
    node.positions = std::move(welded.vertices.positions);
    node.normals = std::move(welded.vertices.normals);
    if (has_uvs) node.uvs = std::move(welded.vertices.uvs);
    node.triangles = std::move(welded.triangles);
    return node;
}

/// The node and all below it, parents first.
void append_nodes(const MeshReader& reader, const aiNode& source, int32_t parent, PolygonMesh& out,
                  PolygonMeshStats& stats) {
    const int32_t index = static_cast<int32_t>(out.nodes.size());
    out.nodes.push_back(read_node(reader, source, out.nodes.size(), stats));
    MeshNode& node = out.nodes.back();
    node.parent = parent;
    if (parent < 0 && reader.traits.is_y_up) node.parent_from_node = z_up_from_y_up() * node.parent_from_node;
    for (unsigned i = 0; i < source.mNumChildren; ++i)
        append_nodes(reader, *source.mChildren[i], index, out, stats);
}

BakingMaterials baking_of(const MaterialSet& materials) {
    BakingMaterials baking;
    for (size_t i = 0; i < materials.materials.size(); ++i) {
        baking.texture.push_back(materials.materials[i].texture);
        baking.is_opaque.push_back(materials.uses[i].is_opaque);
    }
    for (const MeshTexture& texture : materials.textures)
        baking.pyramids.emplace_back(texture);
    return baking;
}

void count_faces(const aiScene& scene, PolygonMeshStats& stats) {
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[i];
        stats.polygons += mesh.mNumFaces;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            stats.larger_than_triangles += mesh.mFaces[f].mNumIndices > 3 ? 1u : 0u;
            stats.dropped_faces += mesh.mFaces[f].mNumIndices < 3 ? 1u : 0u;
        }
    }
}

lod::Result<lod::Ok> triangulate_faces(ModelSource& model, const std::string& path) {
    try {
        model.scene = model.importer->ApplyPostProcessing(aiProcess_Triangulate);
    } catch (const std::exception& problem) {
        return lod::Error{path + ": cannot triangulate: " + problem.what() + "; expected plane polygons"};
    }
    if (model.scene == nullptr)
        return lod::Error{path + ": cannot triangulate: " + model.importer->GetErrorString() +
                          "; expected plane polygons"};
    return lod::Ok{};
}

}  // namespace

uint64_t PolygonMesh::triangle_count() const {
    uint64_t count = 0;
    for (const MeshNode& node : nodes)
        count += node.triangles.size();
    return count;
}

namespace {

/// The node and all below it, their geometry read once for all nodes that show the same meshes.
struct SharedReader {
    const MeshReader& reader;
    SharedModel& model;
    PolygonMeshStats& stats;
    std::map<std::vector<unsigned>, uint32_t> known;
    size_t node_count = 0;

    void append(const aiNode& source, const glm::dmat4& model_from_parent) {
        const size_t index = node_count++;
        const std::vector<unsigned> meshes(source.mMeshes, source.mMeshes + source.mNumMeshes);
        const bool has_own_place = index < reader.node_shifts.size();  // of AC3D: nothing is shared there
        const auto [place, is_new] = known.try_emplace(meshes, static_cast<uint32_t>(model.geometry.size()));
        uint32_t geometry = place->second;
        glm::dmat4 parent_from_node = matrix_of(source.mTransformation);
        if (is_new || has_own_place) {
            geometry = static_cast<uint32_t>(model.geometry.size());
            model.geometry.push_back(read_node(reader, source, index, stats));
            parent_from_node = model.geometry.back().parent_from_node;
        }
        const glm::dmat4 model_from_node = model_from_parent * parent_from_node;
        const bool is_leaf = source.mNumChildren == 0;
        model.nodes.push_back({source.mName.C_Str(), geometry, is_leaf, model_from_node});
        for (unsigned i = 0; i < source.mNumChildren; ++i)
            append(*source.mChildren[i], model_from_node);
    }
};

/// Opens and triangulates a model and hands what its nodes are read with to `read`.
template <typename Read>
lod::Result<lod::Ok> with_reader(const std::string& path, PolygonMeshStats& met, const Read& read) {
    lod::Result<ModelSource> model = open_model(path);
    if (!model) return model.error();
    count_faces(*model->scene, met);
    const lod::Result<lod::Ok> triangulated = triangulate_faces(*model, path);
    if (!triangulated) return triangulated.error();
    const FormatTraits traits = traits_of(model->extension);
    MaterialSet materials = read_materials(*model->scene, path, traits.is_linear);
    met.missing_files = materials.missing_textures;
    met.missing_files.insert(met.missing_files.end(), model->missing_libraries.begin(),
                             model->missing_libraries.end());
    read(MeshReader{*model->scene, traits, materials, baking_of(materials), model->node_shifts}, materials);
    return lod::Ok{};
}

}  // namespace

lod::Result<PolygonMesh> read_polygon_mesh(const std::string& path, PolygonMeshStats* stats) {
    PolygonMeshStats met;
    PolygonMesh mesh;
    const auto outcome = with_reader(path, met, [&](const MeshReader& reader, MaterialSet& materials) {
        if (reader.traits.is_y_up) mesh.file_from_model = glm::transpose(z_up_from_y_up());
        append_nodes(reader, *reader.scene.mRootNode, -1, mesh, met);
        mesh.materials = std::move(materials.materials);
        mesh.textures = std::move(materials.textures);
    });
    if (!outcome) return outcome.error();
    if (mesh.triangle_count() == 0)
        return lod::Error{path + ": not a single triangle; expected a polygon model"};
    if (stats != nullptr) *stats = met;
    return mesh;
}

lod::Result<SharedModel> read_shared_model(const std::string& path, PolygonMeshStats* stats) {
    PolygonMeshStats met;
    SharedModel model;
    const auto outcome = with_reader(path, met, [&](const MeshReader& reader, MaterialSet&) {
        const glm::dmat4 model_from_file = reader.traits.is_y_up ? z_up_from_y_up() : glm::dmat4(1.0);
        SharedReader{reader, model, met, {}}.append(*reader.scene.mRootNode, model_from_file);
    });
    if (!outcome) return outcome.error();
    if (stats != nullptr) *stats = met;
    return model;
}

std::vector<glm::dmat4> model_from_nodes(const PolygonMesh& mesh) {
    std::vector<glm::dmat4> transforms;
    for (const MeshNode& node : mesh.nodes) {
        transforms.push_back(node.parent < 0
                                 ? node.parent_from_node
                                 : transforms[static_cast<size_t>(node.parent)] * node.parent_from_node);
    }
    return transforms;
}

}  // namespace data
