#include "lod/progressive/mesh_sheet.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "lod/base/check.h"

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
    : mesh_(&mesh), slot_of_(mesh.triangle_count(), kNoSlot), is_written_(mesh.hierarchy.node_count(), 0) {
    const auto glass =
        static_cast<uint32_t>(std::count(mesh.is_glass.begin(), mesh.is_glass.end(), uint8_t{1}));
    const std::array<uint32_t, 2> counts{mesh.triangle_count() - glass, glass};
    for (size_t of = 0; of < 2; ++of) {
        classes_[of].triangle_of.reserve(counts[of]);
        classes_[of].dirty.assign(counts[of] / (kPage * 64) + 1, 0);
    }
    classes_[1].first_triangle = counts[0];
    fresh_.reserve(mesh.hierarchy.node_count());
}

PoolRegion MeshSheet::need(const ProgressiveMesh& mesh) {
    return {.vertex_capacity = mesh.hierarchy.node_count(), .index_capacity = 3 * mesh.triangle_count()};
}

void MeshSheet::place(const PoolRegion& region) {
    region_ = region;
    std::fill(is_written_.begin(), is_written_.end(), uint8_t{0});
    for (Class& of : classes_) {
        for (uint32_t slot = 0; slot < of.triangle_of.size(); slot += kPage)
            mark(of, slot);
    }
}

/// Gives a triangle a slot, or its slot to the last; notes what must be written.
void MeshSheet::take(const MeshCut& cut, uint32_t triangle) {
    Class& of = class_of(triangle);
    uint32_t& slot = slot_of_[triangle];
    if (cut.is_drawn(triangle)) {
        if (slot == kNoSlot) {
            slot = static_cast<uint32_t>(of.triangle_of.size());
            of.triangle_of.push_back(triangle);
        }
        mark(of, slot);
        return;
    }
    if (slot == kNoSlot) return;
    const uint32_t last = of.triangle_of.back();
    of.triangle_of[slot] = last;
    of.triangle_of.pop_back();
    slot_of_[last] = slot;
    mark(of, slot);
    slot = kNoSlot;
}

void MeshSheet::stage_vertex(NodeId node, const glm::vec3& displacement_m, StagedWrites& out) {
    const VertexHierarchy& h = mesh_->hierarchy;
    const glm::u8vec4 colour = h.colour[node];
    out.vertex_runs.push_back({region_.first_vertex + node, static_cast<uint32_t>(out.vertices.size()), 1});
    out.vertices.push_back(make_vertex(glm::dvec3(h.position[node]) + glm::dvec3(displacement_m),
                                       h.normal[node], glm::u8vec3(colour), static_cast<Material>(colour.w)));
}

void MeshSheet::stage_pages(const MeshCut& cut, Class& of, StagedWrites& out) {
    const auto used = static_cast<uint32_t>(of.triangle_of.size());
    for (size_t word = 0; word < of.dirty.size(); ++word) {
        for (uint64_t bits = std::exchange(of.dirty[word], 0); bits != 0; bits &= bits - 1) {
            const uint32_t begin =
                (static_cast<uint32_t>(word) * 64 + static_cast<uint32_t>(std::countr_zero(bits))) * kPage;
            const uint32_t end = std::min(begin + kPage, used);
            if (begin >= end) continue;  // what was here is gone
            out.index_runs.push_back({region_.first_index + 3 * (of.first_triangle + begin),
                                      static_cast<uint32_t>(out.indices.size()), 3 * (end - begin)});
            for (uint32_t slot = begin; slot < end; ++slot) {
                for (NodeId corner : cut.corners(of.triangle_of[slot])) {
                    out.indices.push_back(corner);
                    want_vertex(corner);
                }
            }
        }
    }
}

void MeshSheet::update(MeshCut& cut, const NodeGlides& glides, std::span<const NodeId> strayed,
                       StagedWrites& out) {
    for (uint32_t triangle : cut.touched())
        take(cut, triangle);
    cut.forget_touched();
    fresh_.clear();
    for (NodeId node : strayed)
        is_written_[node] = 0;
    for (NodeId node : strayed) {
        if (cut.is_active(node)) want_vertex(node);
    }
    for (Class& of : classes_)
        stage_pages(cut, of, out);
    for (NodeId node : fresh_)
        stage_vertex(node, glides.displacement_m(node), out);
    for (const NodeGlide& glide : glides.all())
        stage_vertex(glide.node, glide.shown_m, out);
}

void MeshSheet::emit(uint32_t instance, std::vector<DrawItem>& out) const {
    for (const Class& of : classes_) {
        if (of.triangle_of.empty()) continue;
        out.push_back({.index_count = 3 * static_cast<uint32_t>(of.triangle_of.size()),
                       .first_index = region_.first_index + 3 * of.first_triangle,
                       .base_vertex = static_cast<int32_t>(region_.first_vertex),
                       .instance = instance,
                       .is_glass = &of == &classes_[1]});
    }
}

std::string MeshSheet::validate(const MeshCut& cut) const {
    if (!cut.touched().empty()) return {};  // told with the next update
    size_t slots = 0;
    for (const Class& of : classes_) {
        slots += of.triangle_of.size();
        for (uint32_t slot = 0; slot < of.triangle_of.size(); ++slot) {
            if (slot_of_[of.triangle_of[slot]] != slot)
                return "slot " + std::to_string(slot) + " is lent twice";
            if (!cut.is_drawn(of.triangle_of[slot]))
                return "slot " + std::to_string(slot) + " shows what is gone";
        }
    }
    return slots == cut.triangle_count() ? "" : "a drawn triangle has no slot";
}

}  // namespace lod
