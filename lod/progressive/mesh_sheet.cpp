#include "lod/progressive/mesh_sheet.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

namespace lod {

void StagedWrites::clear() {
    vertices.clear();
    indices.clear();
    vertex_runs.clear();
    index_runs.clear();
}

void StagedWrites::append_to(DrawList& out) const {
    for (const Run& run : vertex_runs)
        out.vertex_writes.push_back({run.first, {vertices.data() + run.begin, run.count}});
    for (const Run& run : index_runs)
        out.index_writes.push_back({run.first, {indices.data() + run.begin, run.count}});
}

MeshSheet::MeshSheet(const ProgressiveMesh& mesh)
    : mesh_(&mesh),
      slot_of_(mesh.triangle_count(), kNoSlot),
      dirty_(mesh.triangle_count() / (kPage * 64) + 1, 0),
      is_written_(mesh.hierarchy.vertex_count(), 0) {
    triangle_of_.reserve(mesh.triangle_count());
    fresh_.reserve(mesh.hierarchy.vertex_count());
}

PoolRegion MeshSheet::need(const ProgressiveMesh& mesh) {
    return {.vertex_capacity = mesh.hierarchy.vertex_count(), .index_capacity = 3 * mesh.triangle_count()};
}

void MeshSheet::place(const PoolRegion& region) {
    region_ = region;
    std::fill(is_written_.begin(), is_written_.end(), uint8_t{0});
    for (uint32_t slot = 0; slot < triangle_of_.size(); slot += kPage)
        mark(slot);
}

/// Gives a triangle a slot, or its slot to the last; notes what must be written.
void MeshSheet::take(const MeshCut& cut, uint32_t triangle) {
    uint32_t& slot = slot_of_[triangle];
    if (cut.is_drawn(triangle)) {
        if (slot == kNoSlot) {
            slot = static_cast<uint32_t>(triangle_of_.size());
            triangle_of_.push_back(triangle);
        }
        mark(slot);
        return;
    }
    if (slot == kNoSlot) return;
    const uint32_t last = triangle_of_.back();
    triangle_of_[slot] = last;
    triangle_of_.pop_back();
    slot_of_[last] = slot;
    mark(slot);
    slot = kNoSlot;
}

void MeshSheet::stage_vertex(VertexId vertex, const glm::vec3& displacement_m, StagedWrites& out) {
    const VertexHierarchy& h = mesh_->hierarchy;
    const glm::dvec3 place(h.position[h.vertex_node[vertex]]);
    const glm::u8vec4 colour = h.colour[vertex];
    out.vertex_runs.push_back({region_.first_vertex + vertex, static_cast<uint32_t>(out.vertices.size()), 1});
    out.vertices.push_back(make_vertex(place + glm::dvec3(displacement_m), h.normal[vertex],
                                       glm::u8vec3(colour), static_cast<Material>(colour.w)));
}

void MeshSheet::stage_pages(const MeshCut& cut, StagedWrites& out) {
    const auto used = static_cast<uint32_t>(triangle_of_.size());
    for (uint32_t word = 0; word < dirty_.size(); ++word) {
        for (uint64_t bits = std::exchange(dirty_[word], 0); bits != 0; bits &= bits - 1) {
            const uint32_t begin = (word * 64 + static_cast<uint32_t>(std::countr_zero(bits))) * kPage;
            const uint32_t end = std::min(begin + kPage, used);
            if (begin >= end) continue;  // what was here is gone
            out.index_runs.push_back({region_.first_index + 3 * begin,
                                      static_cast<uint32_t>(out.indices.size()), 3 * (end - begin)});
            for (uint32_t slot = begin; slot < end; ++slot) {
                for (VertexId vertex : cut.vertices(triangle_of_[slot])) {
                    out.indices.push_back(vertex);
                    want_vertex(vertex);
                }
            }
        }
    }
}

/// The node's vertices are not where they were last written.
void MeshSheet::recall(NodeId node, bool is_active) {
    is_written_[node] = 0;
    if (is_active) want_vertex(node);
    for (VertexId vertex : mesh_->further(node)) {
        is_written_[vertex] = 0;
        if (is_active) want_vertex(vertex);
    }
}

void MeshSheet::update(MeshCut& cut, const NodeGlides& glides, std::span<const NodeId> strayed,
                       StagedWrites& out) {
    for (uint32_t triangle : cut.touched())
        take(cut, triangle);
    cut.forget_touched();
    fresh_.clear();
    for (NodeId node : strayed)
        recall(node, cut.is_active(node));
    stage_pages(cut, out);
    for (VertexId vertex : fresh_)
        stage_vertex(vertex, glides.displacement_m(mesh_->hierarchy.vertex_node[vertex]), out);
    for (const NodeGlide& glide : glides.all()) {
        stage_vertex(glide.node, glide.shown_m, out);
        for (VertexId vertex : mesh_->further(glide.node))
            stage_vertex(vertex, glide.shown_m, out);
    }
}

void MeshSheet::emit(uint32_t instance, std::vector<DrawItem>& out) const {
    if (triangle_of_.empty()) return;
    out.push_back({.index_count = 3 * static_cast<uint32_t>(triangle_of_.size()),
                   .first_index = region_.first_index,
                   .base_vertex = static_cast<int32_t>(region_.first_vertex),
                   .instance = instance,
                   .is_glass = mesh_->is_glass});
}

std::string MeshSheet::validate(const MeshCut& cut) const {
    if (!cut.touched().empty()) return {};  // told with the next update
    for (uint32_t slot = 0; slot < triangle_of_.size(); ++slot) {
        if (slot_of_[triangle_of_[slot]] != slot) return "slot " + std::to_string(slot) + " is lent twice";
        if (!cut.is_drawn(triangle_of_[slot])) return "slot " + std::to_string(slot) + " shows what is gone";
    }
    return triangle_of_.size() == cut.triangle_count() ? "" : "a drawn triangle has no slot";
}

}  // namespace lod
