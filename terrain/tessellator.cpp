#include "terrain/tessellator.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "lod/base/check.h"
#include "lod/sight_metric.h"

namespace terrain {
namespace {

constexpr uint32_t kPageSize = 64;  ///< vertices to a word of `fresh_`

/// Draws the runs that one view may see, in as few stretches of the list as is sensible.
struct RunPicker {
    /// What lies between two runs is drawn as well when it is at most this many indices: an item costs more.
    static constexpr uint32_t kBridge = 3 * 128;
    /// Nodes of at most this many indices are seen as a whole or not at all.
    static constexpr uint32_t kUnit = 3 * 64;

    const TessellationInput& input;
    const lod::AnchoredEye& eye;
    std::span<const RunNode> nodes;
    std::vector<IndexRange>& stretches;
    uint64_t index_count = 0;    ///< in the stretches, without what fills room
    uint64_t skipped_count = 0;  ///< since the last stretch

    void visit(uint32_t id) {
        const RunNode& node = nodes[id];
        const DiamondIndex diamond = node.triangle.diamond;
        const DiamondBound bound = input.bound_of(input.mesh[diamond], input.ranks[diamond].source);
        // Vertices under way may be shown outside the bound of their own.
        const float radius_m = bound.radius_m + input.glides.farthest_m();
        const float outside = eye.distance_outside_m(eye.to_eye(bound.centre), radius_m);
        if (outside > 0.0f) {
            skipped_count += node.count;
            return;
        }
        if (node.is_run() || node.count <= kUnit || outside < -2.0f * radius_m) return draw(node);
        visit(node.children);
        visit(node.children + 1);
    }

  private:
    /// All that hangs below a node, with what fills its room.
    void draw(const RunNode& node) {
        if (node.count == 0) return;
        index_count += node.count;
        const uint32_t end = node.first + node.room;
        if (!stretches.empty() && node.first - stretches.back().end() <= kBridge) {
            stretches.back().count = end - stretches.back().first;
            index_count += skipped_count;
        } else {
            stretches.push_back({node.first, node.room});
        }
        skipped_count = 0;
    }
};

/// A sample's vertex, beside its place where it is under way.
lod::Vertex ground_vertex(const DiamondTable& table, GridPoint at, float height_m, const glm::vec3& way_m) {
    const GridPoint p = table.domain.clamped(at);
    const glm::dvec3 place = table.frame.world_from_sample(p.x, p.y, double(height_m));
    lod::Vertex vertex;
    lod::split_hi_lo(place + glm::dvec3(way_m), vertex.position_hi, vertex.position_lo);
    lod::set_ground_sample(vertex, p.x, p.y);
    return vertex;
}

/// Slots that patches of so many triangles need if none shared an edge, and an eighth of that for change.
uint64_t patch_slots(uint64_t triangles, int batch) {
    return batch == 0 ? 0 : triangles - triangles / 8 + 64;
}

}  // namespace

void Tessellator::add_vertex(DiamondIndex index) {
    if (index / kPageSize >= fresh_.size()) fresh_.resize(index / kPageSize + 1);
    fresh_[index / kPageSize] |= uint64_t{1} << (index % kPageSize);
}

void Tessellator::change(GridPoint centre) {
    runs_.mark(centre);
}

void Tessellator::forget() {
    std::fill(fresh_.begin(), fresh_.end(), 0);
    runs_.mark_all();
}

lod::PoolRegion Tessellator::need(uint64_t triangles, uint32_t records) const {
    const uint64_t patches = patch_slots(triangles, batch_);
    const bool is_outgrown = records > record_slots_ || patches > region_.vertex_capacity - record_slots_;
    const uint64_t least = batch_ > 0 && is_outgrown ? uint64_t{region_.vertex_capacity} + 1 : 0;
    return {0, static_cast<uint32_t>(std::max(records + patches, least)), 0, IndexRuns::room_for(triangles)};
}

void Tessellator::place(const lod::PoolRegion& region, uint64_t triangles, uint32_t records) {
    region_ = region;
    const uint64_t patches = patch_slots(triangles, batch_);
    record_slots_ = static_cast<uint32_t>(uint64_t{region.vertex_capacity} * records / (records + patches));
    CHECK(record_slots_ >= records && region.vertex_capacity - record_slots_ >= patches);
    const size_t pages = (region.vertex_capacity + kPageSize - 1) / kPageSize;
    vertices_.resize(pages * kPageSize);
    fresh_.resize(std::max(pages, fresh_.size()));
    is_all_stale_ = true;
    patches_.reset(record_slots_, region.vertex_capacity - record_slots_);
    runs_.reset(region.index_capacity);
}

lod::Vertex Tessellator::vertex_at(const TessellationInput& input, uint32_t slot) const {
    if (slot < record_slots_) {
        const Diamond& d = input.mesh[slot];
        const glm::vec3 way_m =
            input.glides.is_empty() ? glm::vec3(0.0f) : input.glides.displacement_m(slot, d.level);
        return ground_vertex(input.table, d.centre(), input.ranks[slot].source.height_m, way_m);
    }
    const PatchVertices::Place& place = patches_[slot];
    const float height_m = input.table.at(place.centre(), place.level).height_m;
    return ground_vertex(input.table, place.centre(), height_m, glm::vec3(0.0f));
}

/// Makes the new vertices of a page; those with a bit in `bits` must be written.
void Tessellator::refresh_page(const TessellationInput& input, uint32_t page, uint64_t bits) {
    for (; bits != 0; bits &= bits - 1) {
        const uint32_t slot = page * kPageSize + static_cast<uint32_t>(std::countr_zero(bits));
        const bool is_shown = slot < record_slots_ ? input.mesh[slot].is_used() && input.mesh[slot].is_split
                                                   : patches_.is_used(slot);
        if (is_shown) vertices_[slot] = vertex_at(input, slot);
    }
}

void Tessellator::write_vertices(const TessellationInput& input, lod::DrawList& out) {
    const uint32_t records = input.mesh.record_count();
    const uint32_t end = patches_.count() > 0 ? patches_.end() : records;
    out.vertex_writes.reserve(out.vertex_writes.size() + region_.vertex_capacity / 2 + 1);  // every other one
    const auto write = [&](uint32_t first, uint32_t behind) {
        out.vertex_writes.push_back({region_.first_vertex + first, {&vertices_[first], behind - first}});
    };
    for (uint32_t page = 0; page * kPageSize < end && page < fresh_.size(); ++page) {
        uint64_t bits = std::exchange(fresh_[page], 0);
        refresh_page(input, page, bits);
        while (bits != 0 && !is_all_stale_) {
            const auto first = static_cast<uint32_t>(std::countr_zero(bits));
            const auto length = static_cast<uint32_t>(std::countr_one(bits >> first));
            write(page * kPageSize + first, page * kPageSize + first + length);
            bits = first + length == kPageSize ? 0 : bits >> (first + length) << (first + length);
        }
    }
    if (is_all_stale_) {
        write(0, records);
        if (end > records) write(record_slots_, end);
    }
    is_all_stale_ = false;
}

void Tessellator::write_indices(const TessellationInput& input, lod::DrawList& out) {
    runs_.update(input.mesh, {input.table, input.mesh, input.ranks, 2 * batch_, patches_, runs_.fresh()});
    for (const uint32_t slot : patches_.made())
        add_vertex(slot);
    out.index_writes.reserve(out.index_writes.size() + runs_.most_runs());
    for (const IndexRange& range : runs_.changed())
        out.index_writes.push_back(
            {region_.first_index + range.first, runs_.list().subspan(range.first, range.count)});
}

void Tessellator::add_items(const TessellationInput& input, const lod::View& view, lod::DrawList& out) {
    const lod::AnchoredEye eye(view, input.bound_of.anchor_world());
    stretches_.clear();
    stretches_.reserve(runs_.most_runs());
    RunPicker picker{input, eye, runs_.nodes(), stretches_};
    picker.visit(0);
    picker.visit(1);
    emitted_ = picker.index_count / 3;
    if (emitted_ == 0) return;
    out.items.reserve(out.items.size() + runs_.most_runs());
    for (const IndexRange& stretch : stretches_) {
        out.items.push_back({stretch.count, region_.first_index + stretch.first,
                             static_cast<int32_t>(region_.first_vertex),
                             static_cast<uint32_t>(out.instances.size()), false});
    }
    out.instances.push_back(
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kTerrain));
}

void Tessellator::emit(const TessellationInput& input, const lod::View& view, lod::DrawList& out) {
    CHECK(input.mesh.record_count() <= record_slots_);
    if (is_first_view_) {
        write_indices(input, out);
        write_vertices(input, out);
        is_first_view_ = false;
    }
    add_items(input, view, out);
}

}  // namespace terrain
