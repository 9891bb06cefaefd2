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
        if (node.count <= kUnit || outside < -2.0f * radius_m) return draw(node);
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

lod::Vertex ground_vertex(const TessellationInput& input, DiamondIndex index) {
    const GridPoint p = input.mesh.domain().clamped(input.mesh[index].centre());
    lod::Vertex vertex;
    const glm::dvec3 world =
        input.table.frame.world_from_sample(p.x, p.y, double(input.ranks[index].source.height_m));
    const glm::dvec3 shown =
        input.glides.is_empty()
            ? world
            : world + glm::dvec3(input.glides.displacement_m(index, input.mesh[index].level));
    lod::split_hi_lo(shown, vertex.position_hi, vertex.position_lo);
    lod::set_ground_sample(vertex, p.x, p.y);
    return vertex;
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

lod::PoolRegion Tessellator::need(uint64_t triangles, uint32_t records) {
    return {0, records, 0, IndexRuns::room_for(triangles)};
}

void Tessellator::place(const lod::PoolRegion& region) {
    region_ = region;
    const size_t pages = (region.vertex_capacity + kPageSize - 1) / kPageSize;
    vertices_.resize(pages * kPageSize);
    fresh_.resize(std::max(pages, fresh_.size()));
    is_all_stale_ = true;
    runs_.reset(region.index_capacity);
}

/// Makes the new vertices of a page; those with a bit in `bits` must be written.
void Tessellator::refresh_page(const TessellationInput& input, uint32_t page, uint64_t bits) {
    for (; bits != 0; bits &= bits - 1) {
        const DiamondIndex index = page * kPageSize + static_cast<uint32_t>(std::countr_zero(bits));
        if (input.mesh[index].is_used() && input.mesh[index].is_split)
            vertices_[index] = ground_vertex(input, index);
    }
}

void Tessellator::write_vertices(const TessellationInput& input, lod::DrawList& out) {
    const uint32_t count = input.mesh.record_count();
    out.vertex_writes.reserve(out.vertex_writes.size() + region_.vertex_capacity / 2 + 1);  // every other one
    const auto write = [&](uint32_t first, uint32_t end) {
        out.vertex_writes.push_back({region_.first_vertex + first, {&vertices_[first], end - first}});
    };
    for (uint32_t page = 0; page * kPageSize < count && page < fresh_.size(); ++page) {
        uint64_t bits = std::exchange(fresh_[page], 0);
        refresh_page(input, page, bits);
        while (bits != 0 && !is_all_stale_) {
            const auto first = static_cast<uint32_t>(std::countr_zero(bits));
            const auto length = static_cast<uint32_t>(std::countr_one(bits >> first));
            write(page * kPageSize + first, page * kPageSize + first + length);
            bits = first + length == kPageSize ? 0 : bits >> (first + length) << (first + length);
        }
    }
    if (is_all_stale_) write(0, count);
    is_all_stale_ = false;
}

void Tessellator::write_indices(const TessellationInput& input, lod::DrawList& out) {
    runs_.update(input.mesh, {{input.table, input.mesh, input.ranks}, runs_.fresh()});
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
    CHECK(input.mesh.record_count() <= region_.vertex_capacity);
    if (is_first_view_) {
        write_vertices(input, out);
        write_indices(input, out);
        is_first_view_ = false;
    }
    add_items(input, view, out);
}

}  // namespace terrain
