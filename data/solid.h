// Solids: extruded shapes, turned profiles and ridged needles, appended to a mesh node.
//
// Lengths in metres, node frame; z is towards the viewer of an instrument. Normals are smooth where faces meet at
// less than about 35 degrees and sharp elsewhere.
#pragma once

#include <functional>
#include <span>

#include "data/outline.h"
#include "data/polygon_mesh.h"

namespace data {

/// Appends solids of one material to one node.
struct SolidTarget {
    PolygonMesh* mesh = nullptr;
    uint32_t node = 0;
    uint32_t material = 0;
    glm::dmat4 node_from_solid{1.0};  ///< rigid
};

/// An extrusion from z0 to z1 with its upper edge bevelled; no lower face.
struct Extrusion {
    double z0 = 0.0, z1 = 0.0;
    double bevel = 0.0;  ///< >= 0, less than half the narrowest part
};
void append_extrusion(const Shape& shape, const Extrusion& extrusion, const SolidTarget& target);

/// A surface of revolution about z. Profile points are (radius, z); the outside is on the left of its way, so it
/// runs from the axis at the top outwards and down.
void append_lathe(std::span<const glm::dvec2> profile, int segments, const SolidTarget& target);

/// A flat needle along +y with a ridge: stations of (y, half width), ascending y; sides from z0 to z1, ridge at
/// z_ridge.
struct NeedleBody {
    double z0 = 0.0, z1 = 0.0, z_ridge = 0.0;
};
void append_needle(std::span<const glm::dvec2> stations, const NeedleBody& body, const SolidTarget& target);

/// Adds a node and returns its index.
uint32_t add_node(PolygonMesh& mesh, const std::string& name, int32_t parent,
                  const glm::dmat4& parent_from_node);

/// Adds a material of an sRGB colour and opacity and returns its index.
uint32_t add_material(PolygonMesh& mesh, const std::string& name, const glm::vec4& colour);

/// Unites vertices of a node that are equal in everything. Triangles keep their order.
void weld(MeshNode& node);

}  // namespace data
