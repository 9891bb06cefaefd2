#include "terrain/tessellator.h"

#include <algorithm>
#include <bit>

#include "lod/base/check.h"
#include "lod/sight_metric.h"
#include "terrain/leaf_cover.h"

namespace terrain {
namespace {

constexpr uint32_t kPageSize = 64;  ///< vertices written together, 2 KiB; a word of `fresh_`

/// Leaves what one view cannot see, writes the rest as indices.
struct IndexWriter {
    /// Whether a subtree may be in view; once fully inside, its children need no test.
    enum class State : uint8_t { kUnknown, kInside };

    const TessellationInput& input;
    const lod::AnchoredEye& eye;
    LeafCover cover;
    std::vector<uint32_t>& indices;

    bool enter(DiamondIndex index, State& state) const {
        if (state == State::kInside) return true;
        const Diamond& d = input.mesh[index];
        const DiamondBound bound = input.bound_of(d, input.ranks[index].source);
        // Vertices under way may be shown outside the bound of their own.
        const float radius_m = bound.radius_m + input.glides.farthest_m();
        const float outside = eye.distance_outside_m(eye.to_eye(bound.centre), radius_m);
        if (outside > 0.0f) return false;
        if (outside < -2.0f * radius_m) state = State::kInside;
        return true;
    }

    /// Counter-clockwise seen from above: rows run south, so left and right change places.
    void leaf(const Leaf& leaf, DiamondIndex diamond, int half) const {
        if (!cover.is_drawn(leaf, diamond, half)) return;
        indices.push_back(leaf.apex);
        indices.push_back(leaf.right);
        indices.push_back(leaf.left);
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

void Tessellator::forget_vertices() {
    std::fill(fresh_.begin(), fresh_.end(), 0);
}

lod::PoolRegion Tessellator::need(uint64_t triangles, uint32_t records) {
    return {0, records, 0, static_cast<uint32_t>(3 * triangles)};
}

void Tessellator::place(const lod::PoolRegion& region) {
    region_ = region;
    const size_t pages = (region.vertex_capacity + kPageSize - 1) / kPageSize;
    vertices_.resize(pages * kPageSize);
    fresh_.resize(std::max(pages, fresh_.size()));
    is_all_stale_ = true;
}

/// Makes the new vertices of a page; whether the page must be written.
bool Tessellator::refresh_page(const TessellationInput& input, uint32_t page) {
    uint64_t bits = page < fresh_.size() ? fresh_[page] : 0;
    if (bits == 0) return is_all_stale_;
    fresh_[page] = 0;
    for (; bits != 0; bits &= bits - 1) {
        const DiamondIndex index = page * kPageSize + static_cast<uint32_t>(std::countr_zero(bits));
        if (input.mesh[index].is_used() && input.mesh[index].is_split)
            vertices_[index] = ground_vertex(input, index);
    }
    return true;
}

void Tessellator::write_vertices(const TessellationInput& input, lod::DrawList& out) {
    const uint32_t page_count = (input.mesh.record_count() + kPageSize - 1) / kPageSize;
    const size_t most_pages = (region_.vertex_capacity + kPageSize - 1) / kPageSize;
    out.vertex_writes.reserve(out.vertex_writes.size() + most_pages / 2 + 1);  // every other page, at most
    uint32_t run_begin = 0, run_length = 0;
    const auto flush = [&] {
        if (run_length == 0) return;
        const uint32_t first = run_begin * kPageSize;
        const uint32_t count = std::min(run_length * kPageSize, region_.vertex_capacity - first);
        out.vertex_writes.push_back({region_.first_vertex + first, {&vertices_[first], count}});
        run_length = 0;
    };
    for (uint32_t page = 0; page < page_count; ++page) {
        if (refresh_page(input, page)) {
            if (run_length == 0) run_begin = page;
            ++run_length;
        } else {
            flush();
        }
    }
    flush();
    is_all_stale_ = false;
}

void Tessellator::emit(const TessellationInput& input, const lod::View& view, lod::DrawList& out) {
    CHECK(input.mesh.record_count() <= region_.vertex_capacity);
    if (is_first_view_) {
        write_vertices(input, out);
        indices_.clear();
        indices_.reserve(region_.index_capacity);
        is_first_view_ = false;
    }
    const size_t first = indices_.size();
    const lod::AnchoredEye eye(view, input.bound_of.anchor_world());
    IndexWriter writer{input, eye, {input.table, input.mesh, input.ranks}, indices_};
    LeafWalk(input.mesh, writer).run(IndexWriter::State::kUnknown);
    emitted_ = (indices_.size() - first) / 3;
    CHECK(indices_.size() <= region_.index_capacity);
    if (emitted_ == 0) return;
    const uint32_t first_index = region_.first_index + static_cast<uint32_t>(first);
    out.index_writes.push_back({first_index, {&indices_[first], indices_.size() - first}});
    lod::Instance instance =
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kTerrain);
    out.instances.push_back(instance);
    out.items.push_back({static_cast<uint32_t>(indices_.size() - first), first_index,
                         static_cast<int32_t>(region_.first_vertex),
                         static_cast<uint32_t>(out.instances.size() - 1), false});
}

}  // namespace terrain
