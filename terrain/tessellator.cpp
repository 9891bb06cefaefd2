#include "terrain/tessellator.h"

#include "lod/base/check.h"
#include "terrain/diamond_metric.h"

namespace terrain {
namespace {

constexpr uint32_t kPageSize = 64;  ///< vertices written together, 2 KiB

/// Whether a subtree may be in view; once fully inside, its children need no test.
enum class Sight : uint8_t { kUnknown, kInside };

/// The walk over one view: recursion depth is at most 2 log2(side) + 1.
struct Walk {
    const TessellationInput& input;
    AnchoredEye eye;
    std::vector<uint32_t>& indices;
    bool has_voids;

    /// Sphere against the frustum: outside, crossing or inside.
    bool is_visible(DiamondIndex index, Sight& sight) const {
        if (sight == Sight::kInside) return true;
        const Diamond& d = input.mesh[index];
        const DiamondBound bound = input.bound_of(d, input.table.at(d.centre(), d.level));
        const float outside = eye.distance_outside_m(eye.to_eye(bound.centre), bound.radius_m);
        if (outside > 0.0f) return false;
        if (outside < -2.0f * bound.radius_m) sight = Sight::kInside;
        return true;
    }

    /// A leaf triangle of level 0 … finest that covers no valid sample.
    bool is_hole(const Diamond& d, int half) const {
        if (!has_voids) return false;
        const int dir = (d.apex_dir + 4 * half) & 7;
        return (input.table.empty_halves[input.table.index(d.centre(), d.level)] >> half_bit(dir) & 1) != 0;
    }

    bool is_squeezed(GridPoint a, GridPoint b, GridPoint c) const {
        const Domain& domain = input.mesh.domain();
        if (domain.in_raster(a) && domain.in_raster(b) && domain.in_raster(c)) return false;
        a = domain.clamped(a);
        b = domain.clamped(b);
        c = domain.clamped(c);
        return int64_t(b.x - a.x) * (c.y - a.y) == int64_t(c.x - a.x) * (b.y - a.y);
    }

    GridPoint at(DiamondIndex index) const { return input.mesh[index].centre(); }

    /// Counter-clockwise seen from above: rows run south, so left and right change places.
    void leaf(DiamondIndex apex, DiamondIndex left, DiamondIndex right) const {
        indices.push_back(apex);
        indices.push_back(right);
        indices.push_back(left);
    }

    /// The triangle (apex; left, right) whose hypotenuse has the middle `index`; half: which parent is the apex.
    void triangle(DiamondIndex index, int half, DiamondIndex left, DiamondIndex right, Sight sight) const {
        const Diamond& d = input.mesh[index];
        if (!is_visible(index, sight)) return;
        const DiamondIndex apex = d.parent[half];
        if (!d.is_split) {
            if (!is_squeezed(at(apex), at(left), at(right)) && !is_hole(d, half)) leaf(apex, left, right);
            return;
        }
        // C1 is on the left of C0 seen from the centre; sides 0 and 3 belong to apex C0, 1 and 2 to C2.
        const int first = half == 0 ? 0 : 2, second = half == 0 ? 3 : 1;
        finer(index, first, apex, left, sight);
        finer(index, second, right, apex, sight);
    }

    /// The half of a split triangle behind one side: its apex is the diamond just split.
    void finer(DiamondIndex index, int side, DiamondIndex from, DiamondIndex to, Sight sight) const {
        const DiamondIndex child = input.mesh.child(index, side);
        if (child == kOutside) {  // finest level: cells' halves, drawn unless a corner is void
            const GridPoint a = at(index), b = at(from), c = at(to);
            if (is_squeezed(a, b, c) || (has_voids && (is_void(a) || is_void(b) || is_void(c)))) return;
            leaf(index, from, to);
            return;
        }
        const int half = input.mesh[child].parent[0] == index ? 0 : 1;
        triangle(child, half, from, to, sight);
    }

    bool is_void(GridPoint p) const {
        p = input.mesh.domain().clamped(p);
        return input.grid.void_at(p.x, p.y);
    }
};

lod::Vertex ground_vertex(const TessellationInput& input, DiamondIndex index) {
    const GridPoint p = input.mesh.domain().clamped(input.mesh[index].centre());
    lod::Vertex vertex;
    const glm::dvec3 world = input.grid.frame.world_from_sample(p.x, p.y, double(input.grid.at(p.x, p.y)));
    lod::split_hi_lo(world, vertex.position_hi, vertex.position_lo);
    vertex.surface[0] = static_cast<uint16_t>(p.x);
    vertex.surface[1] = static_cast<uint16_t>(p.y);
    vertex.colour[0] = vertex.colour[1] = vertex.colour[2] = 255;
    vertex.colour[3] = static_cast<uint8_t>(lod::Material::kGround);
    return vertex;
}

}  // namespace

void Tessellator::add_vertex(DiamondIndex index) {
    fresh_.push_back(index);
}

lod::PoolRegion Tessellator::need(uint64_t triangles, uint32_t records) {
    return {0, records, 0, static_cast<uint32_t>(3 * triangles)};
}

void Tessellator::place(const lod::PoolRegion& region) {
    region_ = region;
    const size_t pages = (region.vertex_capacity + kPageSize - 1) / kPageSize;
    vertices_.resize(pages * kPageSize);
    dirty_pages_.assign((pages + 63) / 64, ~uint64_t{0});
}

void Tessellator::write_vertices(const TessellationInput& input, lod::DrawList& out) {
    for (DiamondIndex index : fresh_) {
        if (!input.mesh[index].is_used || !input.mesh[index].is_split) continue;
        vertices_[index] = ground_vertex(input, index);
        dirty_pages_[index / kPageSize / 64] |= uint64_t{1} << (index / kPageSize % 64);
    }
    fresh_.clear();
    const uint32_t page_count = (input.mesh.record_count() + kPageSize - 1) / kPageSize;
    uint32_t run_begin = 0, run_length = 0;
    const auto flush = [&] {
        if (run_length == 0) return;
        const uint32_t first = run_begin * kPageSize;
        const uint32_t count = std::min(run_length * kPageSize, region_.vertex_capacity - first);
        out.vertex_writes.push_back({region_.first_vertex + first, {&vertices_[first], count}});
        run_length = 0;
    };
    for (uint32_t page = 0; page < page_count; ++page) {
        if ((dirty_pages_[page / 64] >> (page % 64) & 1) != 0) {
            if (run_length == 0) run_begin = page;
            ++run_length;
        } else {
            flush();
        }
    }
    flush();
    std::fill(dirty_pages_.begin(), dirty_pages_.end(), 0);
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
    const AnchoredEye eye(view, input.bound_of.anchor_world());
    const Walk walk{input, eye, indices_, input.grid.has_voids()};
    const Diamond& root = input.mesh[kRoot];
    // Domain corners: 0 (0,0), 1 (side,0), 2 (0,side), 3 (side,side).
    for (int half = 0; half < 2; ++half) {
        const GridPoint left =
            step_from(root.centre(), root.apex_dir + 4 * half + 2, input.mesh.domain().reach(0));
        const DiamondIndex left_index = (left.x == 0 ? 0u : 1u) + (left.y == 0 ? 0u : 2u);
        walk.triangle(kRoot, half, left_index, 3u - left_index, Sight::kUnknown);
    }
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
