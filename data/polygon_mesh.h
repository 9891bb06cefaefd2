// PolygonMesh: a model file's nodes, polygons and materials, triangulated, in metres, y up turned to z up.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "lod/base/result.h"

namespace data {

/// Surface properties of a run of triangles.
struct MeshMaterial {
    std::string name;
    glm::vec4 colour{0.8f, 0.8f, 0.8f, 1.0f};  ///< sRGB and opacity, [0, 1]
    float emission = 0.0f;                     ///< [0, 1]: 1 is self-luminous
    int32_t texture = -1;                      ///< into PolygonMesh::textures, -1: none
};

/// A texture's pixels, for sampling into colours.
struct MeshTexture {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;  ///< [height * width * 4], row 0 at v = 0
};

/// One node: its own triangles in its own frame. Nodes are what moves: needles, drums, knobs.
struct MeshNode {
    std::string name;
    int32_t parent = -1;  ///< index of an earlier node, -1 for a root
    glm::dmat4 parent_from_node{1.0};
    std::vector<glm::vec3> positions;  ///< [vertices], node frame, metres
    std::vector<glm::vec3> normals;    ///< [vertices], unit length, always present
    std::vector<glm::vec2> uvs;        ///< [vertices] or empty
    std::vector<glm::u8vec4>
        colours;  ///< [vertices]: material, vertex and texture colour baked, sRGB + opacity
    std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise outside
    std::vector<uint32_t> triangle_material;         ///< [triangles], into PolygonMesh::materials
};

struct PolygonMesh {
    glm::dmat4 file_from_model{1.0};  ///< back from z up to the file's own axes
    std::vector<MeshNode> nodes;      ///< parents before children
    std::vector<MeshMaterial> materials;
    std::vector<MeshTexture> textures;

    uint64_t triangle_count() const;
};

/// What the reader met.
struct PolygonMeshStats {
    uint64_t polygons = 0;                   ///< faces in the file
    uint64_t larger_than_triangles = 0;      ///< of those, with more than three corners
    uint64_t dropped_faces = 0;              ///< points, lines, triangles with two equal corners
    std::vector<std::string> missing_files;  ///< textures (then the material's colour is used) and material
                                             ///< libraries (then grey) that are named and cannot be read
};

/// Reads a polygon model through Assimp: AC3D, glTF/GLB, OBJ, PLY, STL and whatever else it opens; .gz by zlib.
/// Node transforms are kept; n-gons are triangulated (n - 2 triangles, also non-convex ones). Smooth normals with
/// creases at 40 degrees are made where the file has none, and for STL, whose facet normals say no more than its
/// triangles. Corners that agree in everything are one vertex. Mesh frame: +z up, front towards -y. Files that
/// are y-up by definition (glTF, AC3D) get the turn (x, y, z) -> (x, -z, y) in their root nodes' transforms; all
/// others are taken as they are. Node frames below the roots stay those of the file.
/// Fails on unreadable files, on truncated ones where the format tells (data/model_truncation.h), on coordinates
/// that are not finite and on files without a single triangle.
lod::Result<PolygonMesh> read_polygon_mesh(const std::string& path, PolygonMeshStats* stats = nullptr);

/// A model with its equal nodes' geometry stored once.
struct SharedModel {
    struct Node {
        std::string name;
        uint32_t geometry = 0;  ///< into `geometry`
        bool is_leaf = false;   ///< no node below it
        glm::dmat4 model_from_node{1.0};
    };
    std::vector<MeshNode> geometry;  ///< node frame; may be without triangles; names and parents say nothing
    std::vector<Node> nodes;         ///< parents before children, those without geometry too
};

/// read_polygon_mesh for scenes of many nodes: nodes that show the same meshes of the file share one geometry.
/// A file without triangles is no error here. Fails as read_polygon_mesh.
lod::Result<SharedModel> read_shared_model(const std::string& path, PolygonMeshStats* stats = nullptr);

/// World-of-the-model transform of every node: parents applied.
std::vector<glm::dmat4> model_from_nodes(const PolygonMesh& mesh);

}  // namespace data
