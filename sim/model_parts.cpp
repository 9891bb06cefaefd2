#include "sim/model_parts.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace sim {

namespace {

constexpr size_t kTrianglesPerPart = 4096;
constexpr uint32_t kUnused = UINT32_MAX;
constexpr std::array kMaterials{lod::Material::kPaint, lod::Material::kGlow, lod::Material::kGlass};

size_t material_slot(const data::MeshMaterial& material) {
    if (material.colour.w < 0.5f) return 2;
    return material.emission > 0.5f ? 1 : 0;
}

std::optional<double> units_per_turn(const std::string& name) {
    const size_t mark = name.rfind('_');
    if (mark == std::string::npos) return std::nullopt;
    double units = 0.0;
    const char *begin = name.data() + mark + 1, *end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(begin, end, units);
    if (error != std::errc() || stop != end || !std::isfinite(units) || units == 0.0) return std::nullopt;
    return units;
}

/// Every node's body, and how its own frame lies in it.
struct NodeBodies {
    std::vector<uint32_t> body;
    std::vector<glm::dmat4> body_from_node;
};

/// The rigid frame at a node: its origin, its z axis, and x and y made square to it.
glm::dmat4 rigid_frame(const glm::dmat4& node) {
    const glm::dvec3 z = glm::normalize(glm::dvec3(node[2]));
    const glm::dvec3 across(node[0]);
    const glm::dvec3 x = glm::normalize(across - z * glm::dot(across, z));
    return {glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), node[3]};
}

const Drive* drive_of(const std::string& node, std::span<const Drive> drives) {
    for (const Drive& drive : drives) {
        if (drive.node == node) return &drive;
    }
    return nullptr;
}

/// Gives the node a body of its own when a drive names it, else its parent's.
void assign_body(const data::MeshNode& node, const Drive* drive, NodeBodies& nodes, ModelParts& out) {
    const bool is_root = node.parent < 0;
    const size_t parent = is_root ? 0 : static_cast<size_t>(node.parent);
    const uint32_t carrier = is_root ? 0 : nodes.body[parent];
    const glm::dmat4 carrier_from_node =
        (is_root ? glm::dmat4(1.0) : nodes.body_from_node[parent]) * node.parent_from_node;
    if (drive == nullptr) {
        nodes.body.push_back(carrier);
        nodes.body_from_node.push_back(carrier_from_node);
        return;
    }
    const glm::dmat4 frame = rigid_frame(carrier_from_node);
    MovingBody moving{.body = static_cast<uint32_t>(out.bodies.size()), .parent = carrier};
    moving.parent_from_rest = glm::dmat3(frame);
    moving.origin_parent_m = glm::dvec3(frame[3]);
    moving.signal = drive->signal;
    moving.units_per_turn = *units_per_turn(node.name);
    out.bodies.push_back(carried_by(out.bodies[carrier], moving.parent_from_rest, moving.origin_parent_m));
    out.moving.push_back(moving);
    nodes.body.push_back(moving.body);
    nodes.body_from_node.push_back(glm::inverse(frame) * carrier_from_node);
}

/// Collects the triangles of one body and transparency; starts a new part when the open one is full.
class PartBuilder {
  public:
    PartBuilder(const data::PolygonMesh& mesh, uint32_t body, bool is_glass, std::vector<lod::RigidPart>& out)
        : mesh_(mesh), body_(body), is_glass_(is_glass), out_(out) {}

    void append(const data::MeshNode& node, const glm::dmat4& body_from_node) {
        begin_node(node);
        const glm::dmat3 linear(body_from_node);
        const glm::dmat3 turn_normal = glm::transpose(glm::inverse(linear));
        const bool is_mirrored = glm::determinant(linear) < 0.0;
        for (size_t t = 0; t < node.triangles.size(); ++t) {
            const size_t slot = material_slot(mesh_.materials[node.triangle_material[t]]);
            if ((kMaterials[slot] == lod::Material::kGlass) != is_glass_) continue;
            if (part_ == nullptr || part_->indices.size() >= 3 * kTrianglesPerPart) begin_part(node);
            const auto [a, b, c] = node.triangles[t];
            for (uint32_t corner : {a, is_mirrored ? c : b, is_mirrored ? b : c}) {
                uint32_t& kept = kept_[slot][corner];
                if (kept == kUnused) {
                    kept = static_cast<uint32_t>(part_->vertices.size());
                    const glm::dvec3 at(body_from_node * glm::dvec4(glm::dvec3(node.positions[corner]), 1.0));
                    const glm::vec3 normal(glm::normalize(turn_normal * glm::dvec3(node.normals[corner])));
                    const glm::u8vec3 colour(node.colours[corner]);
                    part_->vertices.push_back(lod::make_vertex(at, normal, colour, kMaterials[slot]));
                }
                part_->indices.push_back(kept);
            }
        }
    }

  private:
    void begin_node(const data::MeshNode& node) {
        for (std::vector<uint32_t>& kept : kept_)
            kept.assign(node.positions.size(), kUnused);
    }
    void begin_part(const data::MeshNode& node) {
        out_.push_back({.body = body_, .vertices = {}, .indices = {}, .is_glass = is_glass_});
        part_ = &out_.back();
        begin_node(node);
    }

    const data::PolygonMesh& mesh_;
    uint32_t body_;
    bool is_glass_;
    std::vector<lod::RigidPart>& out_;
    lod::RigidPart* part_ = nullptr;                             ///< the open one: out_.back()
    std::array<std::vector<uint32_t>, kMaterials.size()> kept_;  ///< the current node's vertices in the part
};

void append_parts(const data::PolygonMesh& mesh, const NodeBodies& nodes, ModelParts& out) {
    for (const bool is_glass : {false, true}) {
        for (uint32_t body = 0; body < out.bodies.size(); ++body) {
            PartBuilder builder(mesh, body, is_glass, out.parts);
            for (size_t node = 0; node < mesh.nodes.size(); ++node) {
                if (nodes.body[node] == body) builder.append(mesh.nodes[node], nodes.body_from_node[node]);
            }
        }
    }
}

}  // namespace

lod::Result<ModelParts> make_model_parts(const data::PolygonMesh& mesh, const lod::BodyPose& placement,
                                         std::span<const Drive> drives) {
    ModelParts model;
    model.bodies.push_back(placement);
    for (const Drive& drive : drives) {
        if (!units_per_turn(drive.node)) {
            return lod::Error{"drive " + drive.node +
                              ": expected a name that ends in _ and its units per turn"};
        }
        bool is_found = false;
        for (const data::MeshNode& node : mesh.nodes)
            is_found |= node.name == drive.node;
        if (!is_found) return lod::Error{"drive " + drive.node + ": the model has no node of that name"};
    }
    NodeBodies nodes;
    for (const data::MeshNode& node : mesh.nodes)
        assign_body(node, drive_of(node.name, drives), nodes, model);
    append_parts(mesh, nodes, model);
    return model;
}

void append_model(const ModelParts& model, ModelParts& to) {
    const uint32_t first_body = static_cast<uint32_t>(to.bodies.size());
    to.bodies.insert(to.bodies.end(), model.bodies.begin(), model.bodies.end());
    for (lod::RigidPart part : model.parts) {
        part.body += first_body;
        to.parts.push_back(std::move(part));
    }
    for (MovingBody moving : model.moving) {
        moving.body += first_body;
        moving.parent += first_body;
        to.moving.push_back(moving);
    }
}

}  // namespace sim
