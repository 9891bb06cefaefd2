#include "terrain/rivals/chunked_quadtree.h"

#include <limits>

#include "lod/base/check.h"
#include "lod/base/hash.h"

namespace terrain {
namespace {

constexpr double kFlat_px = 1e-30;  ///< worth refining at tolerance 0 only
constexpr double kInfinity = std::numeric_limits<double>::infinity();

uint32_t grid_vertex_count(GridPoint quads) {
    return static_cast<uint32_t>((quads.x + 1) * (quads.y + 1));
}

/// The rim of a grid of vertices, clockwise from the north-west, 2 (x + y) of them.
std::vector<GridPoint> rim_of(GridPoint quads) {
    std::vector<GridPoint> rim;
    for (int i = 0; i < quads.x; ++i)
        rim.push_back({i, 0});
    for (int j = 0; j < quads.y; ++j)
        rim.push_back({quads.x, j});
    for (int i = quads.x; i > 0; --i)
        rim.push_back({i, quads.y});
    for (int j = quads.y; j > 0; --j)
        rim.push_back({0, j});
    return rim;
}

}  // namespace

ChunkedQuadtree::ChunkedQuadtree(const data::HeightGrid& grid, int cells, unsigned threads)
    : grid_(grid),
      tree_(make_chunk_tree(grid, cells, threads)),
      state_(tree_.chunks.size(), State::kBelow),
      sights_(tree_.chunks.size()),
      refine_(tree_.chunks.size()),
      coarsen_(tree_.chunks.size()) {
    CHECK(cells <= 256);
    uint64_t vertices = 0;
    for (const Chunk& chunk : tree_.chunks) {
        pattern_.push_back(static_cast<uint8_t>(add_pattern(chunk.quads)));
        first_vertex_.push_back(static_cast<uint32_t>(vertices));
        vertices +=
            grid_vertex_count(chunk.quads) + static_cast<uint32_t>(2 * (chunk.quads.x + chunk.quads.y));
    }
    CHECK(vertices <= INT32_MAX);
    first_vertex_.push_back(static_cast<uint32_t>(vertices));
    state_[0] = State::kDrawn;
    triangles_ = triangles_of(0);
    for (uint32_t i = 0; i < tree_.chunks.size(); ++i)
        rank(i);
}

size_t ChunkedQuadtree::add_pattern(GridPoint quads) {
    for (size_t i = 0; i < patterns_.size(); ++i) {
        if (patterns_[i].quads == quads) return i;
    }
    Pattern pattern{quads, static_cast<uint32_t>(indices_.size()), 0};
    const auto at = [&](int i, int j) { return static_cast<uint32_t>(j * (quads.x + 1) + i); };
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) { indices_.insert(indices_.end(), {a, b, c}); };
    for (int j = 0; j < quads.y; ++j) {
        for (int i = 0; i < quads.x; ++i) {
            const uint32_t nw = at(i, j), ne = at(i + 1, j), sw = at(i, j + 1), se = at(i + 1, j + 1);
            const bool is_even = ((i + j) & 1) == 0;
            add(nw, sw, is_even ? se : ne);
            add(se, ne, is_even ? nw : sw);
        }
    }
    const std::vector<GridPoint> rim = rim_of(quads);
    const uint32_t lower = grid_vertex_count(quads);
    for (uint32_t k = 0; k < rim.size(); ++k) {
        const uint32_t next = k + 1 < rim.size() ? k + 1 : 0;
        const uint32_t a = at(rim[k].x, rim[k].y), b = at(rim[next].x, rim[next].y);
        add(a, b, lower + k);
        add(b, lower + next, lower + k);
    }
    pattern.index_count = static_cast<uint32_t>(indices_.size()) - pattern.first_index;
    patterns_.push_back(pattern);
    CHECK(patterns_.size() <= 256);
    return patterns_.size() - 1;
}

void ChunkedQuadtree::add_vertices(const Chunk& chunk, std::vector<lod::Vertex>& out) const {
    for (int j = 0; j <= chunk.quads.y; ++j) {
        for (int i = 0; i <= chunk.quads.x; ++i) {
            const GridPoint p = chunk_sample(grid_, chunk, i, j);
            out.push_back(ground_vertex(grid_, p.x, p.y));
        }
    }
    for (const GridPoint& at : rim_of(chunk.quads)) {
        const GridPoint p = chunk_sample(grid_, chunk, at.x, at.y);
        out.push_back(ground_vertex(grid_, p.x, p.y, double(chunk.skirt_m)));
    }
}

double ChunkedQuadtree::chunk_error_px(uint32_t chunk) const {
    return sights_[chunk].error_px(double(tree_.chunks[chunk].error_m));
}

/// All its children are drawn.
bool ChunkedQuadtree::can_merge(uint32_t chunk) const {
    if (state_[chunk] != State::kSplit) return false;
    for (const uint32_t child : tree_.chunks[chunk].child) {
        if (child != Chunk::kNone && state_[child] != State::kDrawn) return false;
    }
    return true;
}

ChunkedQuadtree::Keys ChunkedQuadtree::keys_of(uint32_t chunk) const {
    Keys keys{0.0, -kInfinity};
    const bool is_visible = sights_[chunk].is_visible();
    if (state_[chunk] == State::kDrawn && !tree_.chunks[chunk].is_leaf() && is_visible)
        keys.refine_px = std::max(chunk_error_px(chunk), kFlat_px);
    if (can_merge(chunk)) keys.minus_coarsen_px = -chunk_error_px(chunk);
    return keys;
}

void ChunkedQuadtree::rank(uint32_t chunk) {
    const Keys keys = keys_of(chunk);
    refine_.set(chunk, keys.refine_px);
    coarsen_.set(chunk, keys.minus_coarsen_px);
}

void ChunkedQuadtree::begin_frame(std::span<const lod::View> views, double) {
    CHECK(!views.empty());
    views_.clear();
    for (const lod::View& view : views)
        views_.push_back(lod::metric_of(view));
    is_first_view_ = true;
    for (uint32_t chunk = 0; chunk < tree_.chunks.size(); ++chunk) {
        if (state_[chunk] == State::kBelow) continue;
        sights_[chunk] = sight_of(views_, tree_.chunks[chunk].box);
        const Keys keys = keys_of(chunk);
        refine_.set_loosely(chunk, keys.refine_px);
        coarsen_.set_loosely(chunk, keys.minus_coarsen_px);
    }
    refine_.reorder();
    coarsen_.reorder();
}

double ChunkedQuadtree::refine_error_px() {
    return refine_.top_key();
}

double ChunkedQuadtree::coarsen_error_px() {
    return -coarsen_.top_key();
}

double ChunkedQuadtree::error_px() {
    return refine_.top_key() <= kFlat_px ? 0.0 : refine_.top_key();
}

/// Replaces a drawn chunk by its children, or drawn children by their parent.
lod::Step ChunkedQuadtree::set_split(uint32_t chunk, bool is_split) {
    const uint64_t before = triangles_;
    const Chunk& parent = tree_.chunks[chunk];
    state_[chunk] = is_split ? State::kSplit : State::kDrawn;
    triangles_ += is_split ? 0 : triangles_of(chunk);
    triangles_ -= is_split ? triangles_of(chunk) : 0;
    for (const uint32_t child : parent.child) {
        if (child == Chunk::kNone) continue;
        state_[child] = is_split ? State::kDrawn : State::kBelow;
        if (is_split) sights_[child] = sight_of(views_, tree_.chunks[child].box);
        triangles_ += is_split ? triangles_of(child) : 0;
        triangles_ -= is_split ? 0 : triangles_of(child);
        rank(child);
    }
    rank(chunk);
    if (parent.parent != Chunk::kNone) rank(parent.parent);
    ++operations_[is_split ? lod::OperationKind::kClusterRefine : lod::OperationKind::kClusterCoarsen];
    return {static_cast<int64_t>(triangles_) - static_cast<int64_t>(before), 1};
}

lod::Step ChunkedQuadtree::refine() {
    if (refine_error_px() <= 0.0) return {};
    return set_split(refine_.top(), true);
}

lod::Step ChunkedQuadtree::coarsen(double limit_px) {
    if (coarsen_error_px() > limit_px || coarsen_error_px() == kInfinity) return {};
    return set_split(coarsen_.top(), false);
}

uint64_t ChunkedQuadtree::hash() const {
    uint64_t hash = tree_.chunks.size();
    for (uint32_t chunk = 0; chunk < tree_.chunks.size(); ++chunk) {
        if (state_[chunk] == State::kDrawn) hash = lod::hash_combine(hash, chunk);
    }
    return hash;
}

lod::PoolRegion ChunkedQuadtree::pool_need() const {
    return {0, first_vertex_.back(), 0, static_cast<uint32_t>(indices_.size())};
}

void ChunkedQuadtree::place(const lod::PoolRegion& region) {
    region_ = region;
    vertices_.place();
    are_indices_written_ = false;
}

void ChunkedQuadtree::emit(const lod::View& view, lod::DrawList& out) {
    CHECK(region_.vertex_capacity >= first_vertex_.back() && region_.index_capacity >= indices_.size());
    if (is_first_view_) {
        vertices_.write(region_.first_vertex, out, [&](std::vector<lod::Vertex>& vertices) {
            vertices.reserve(first_vertex_.back());
            for (const Chunk& chunk : tree_.chunks)
                add_vertices(chunk, vertices);
        });
        if (!are_indices_written_) out.index_writes.push_back({region_.first_index, indices_});
        are_indices_written_ = true;
        is_first_view_ = false;
    }
    const lod::ViewMetric metric = lod::metric_of(view);
    const auto instance = static_cast<uint32_t>(out.instances.size());
    out.instances.push_back(
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kTerrain));
    emitted_ = 0;
    for (uint32_t chunk = 0; chunk < tree_.chunks.size(); ++chunk) {
        if (state_[chunk] != State::kDrawn || !sight_of(metric, tree_.chunks[chunk].box).is_visible())
            continue;
        const Pattern& pattern = patterns_[pattern_[chunk]];
        out.items.push_back({pattern.index_count, region_.first_index + pattern.first_index,
                             static_cast<int32_t>(region_.first_vertex + first_vertex_[chunk]), instance,
                             false});
        emitted_ += triangles_of(chunk);
    }
}

std::string ChunkedQuadtree::validate() const {
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < tree_.chunks.size(); ++i) {
        const std::string name = "chunk " + std::to_string(i);
        const uint32_t parent = tree_.chunks[i].parent;
        const bool is_above_split = parent == Chunk::kNone || state_[parent] == State::kSplit;
        if (is_above_split == (state_[i] == State::kBelow)) return name + " does not match its parent";
        if (state_[i] == State::kSplit && tree_.chunks[i].is_leaf())
            return name + " is split without children";
        if (state_[i] == State::kDrawn) triangles += triangles_of(i);
        const Keys keys = keys_of(i);
        if (refine_.key(i) != keys.refine_px) return name + " has an old key for refinement";
        if (coarsen_.key(i) != keys.minus_coarsen_px) return name + " has an old key for coarsening";
        if (keys.refine_px > refine_.top_key() || keys.minus_coarsen_px > coarsen_.top_key())
            return name + " should be on top";
    }
    if (triangles == triangles_) return "";
    return "triangles: counted " + std::to_string(triangles) + ", said " + std::to_string(triangles_);
}

uint64_t ChunkedQuadtree::memory_bytes() const {
    return tree_.chunks.size() * (sizeof(Chunk) + sizeof(State) + sizeof(Sight) + 1) +
           first_vertex_.size() * sizeof(uint32_t) + indices_.size() * sizeof(uint32_t) +
           refine_.memory_bytes() + coarsen_.memory_bytes();
}

}  // namespace terrain
