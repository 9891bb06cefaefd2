#include "sim/model_parts.h"

#include <array>

#include "sim/model_bodies.h"

namespace sim {

namespace {

constexpr size_t kTrianglesPerPart = 4096;
constexpr uint32_t kUnused = UINT32_MAX;
constexpr std::array kMaterials{lod::Material::kPaint, lod::Material::kGlow, lod::Material::kGlass};

size_t material_slot(const data::MeshMaterial& material) {
    if (material.colour.w < 0.5f) return 2;
    return material.emission > 0.5f ? 1 : 0;
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

void append_parts(const data::PolygonMesh& mesh, const ModelBodies& bodies, ModelParts& out) {
    for (const bool is_glass : {false, true}) {
        for (uint32_t body = 0; body < out.bodies.size(); ++body) {
            PartBuilder builder(mesh, body, is_glass, out.parts);
            for (size_t node = 0; node < mesh.nodes.size(); ++node) {
                if (bodies.body_of_node[node] == body)
                    builder.append(mesh.nodes[node], bodies.body_from_node[node]);
            }
        }
    }
}

}  // namespace

lod::Result<ModelParts> make_model_parts(const data::PolygonMesh& mesh, const lod::BodyPose& placement,
                                         std::span<const Drive> drives) {
    std::vector<ModelNode> nodes;
    for (const data::MeshNode& node : mesh.nodes)
        nodes.push_back({node.name, node.parent, node.parent_from_node});
    lod::Result<ModelBodies> bodies = make_model_bodies(nodes, placement, drives);
    if (!bodies) return bodies.error();
    ModelParts model{{}, bodies->bodies, bodies->moving};
    append_parts(mesh, *bodies, model);
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
