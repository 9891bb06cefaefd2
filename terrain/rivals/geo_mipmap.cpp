#include "terrain/rivals/geo_mipmap.h"

#include "lod/base/check.h"
#include "lod/base/parallel.h"

namespace terrain {
namespace {

/// Errors of a block at every decimation, [shift]; stitched: what a coarser neighbour makes of the block's strip on
/// a side, the worst over all finer decimations, [shift of the neighbour][side].
struct BlockErrors {
    std::vector<float> plain_m;
    std::vector<std::array<float, 4>> stitched_m;
};

float worst_error_m(const data::HeightGrid& grid, GridPoint origin,
                    const std::vector<CellTriangle>& triangles) {
    const auto at = [&](GridPoint p) { return GridPoint{origin.x + p.x, origin.y + p.y}; };
    float worst = 0.0f;
    for (const CellTriangle& t : triangles)
        worst = std::max(worst, surface_error_m(grid, at(t[0]), at(t[1]), at(t[2])));
    return worst;
}

BlockErrors errors_of(const data::HeightGrid& grid, GridPoint origin, const BlockShape& shape) {
    const int top = shape.top_shift();
    BlockErrors errors;
    std::vector<CellTriangle> triangles;
    for (int shift = 0; shift <= top; ++shift) {
        triangles.clear();
        add_plain(shape, shift, triangles);
        errors.plain_m.push_back(worst_error_m(grid, origin, triangles));
        std::array<float, 4>& stitched = errors.stitched_m.emplace_back();
        for (int side = 0; side < 4; ++side) {
            for (int finer = 0; finer < shift; ++finer) {
                triangles.clear();
                add_strip(shape, side, finer, shift, triangles);
                const auto s = static_cast<size_t>(side);
                stitched[s] = std::max(stitched[s], worst_error_m(grid, origin, triangles));
            }
        }
    }
    return errors;
}

Ladders make_ladders(const data::HeightGrid& grid, const BlockGrid& blocks, unsigned threads) {
    std::vector<BlockErrors> errors(blocks.count());
    lod::parallel_for(blocks.count(), threads, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto block = static_cast<uint32_t>(i);
            errors[i] = errors_of(grid, blocks.origin(block), {blocks.cells, blocks.size(block)});
        }
    });
    Ladders ladders;
    for (uint32_t block = 0; block < blocks.count(); ++block) {
        std::vector<Rung> rungs;
        for (size_t shift = errors[block].plain_m.size(); shift-- > 0;) {
            Rung& rung = rungs.emplace_back();
            rung.error_m = errors[block].plain_m[shift];
            for (int side = 0; side < 4; ++side) {
                const uint32_t other = blocks.neighbour(block, side);
                if (other == BlockGrid::kNoBlock) continue;
                rung.side_error_m[side] = errors[other].stitched_m[shift][static_cast<size_t>(side ^ 2)];
            }
        }
        ladders.add(rungs);
    }
    return ladders;
}

}  // namespace

GeoMipmapFront::GeoMipmapFront(const data::HeightGrid& grid, int cells, unsigned threads)
    : LadderFront(grid, make_block_grid(grid.width, grid.height, cells)) {
    CHECK(cells >= 2 && cells <= 128 && (cells & (cells - 1)) == 0);
    for (uint32_t block = 0; block < blocks().count(); ++block) {
        const GridPoint size = blocks().size(block);
        size_t book = 0;
        while (book < books_.size() && books_[book].shape.size != size)
            ++book;
        if (book == books_.size()) add_book({cells, size});
        book_.push_back(static_cast<uint8_t>(book));
    }
    top_shift_ = books_.front().shape.top_shift();
    start(make_ladders(grid, blocks(), threads));
}

GeoMipmapFront::Pattern GeoMipmapFront::add_pattern(const std::vector<CellTriangle>& triangles) {
    const Pattern pattern{static_cast<uint32_t>(indices_.size()),
                          static_cast<uint32_t>(3 * triangles.size())};
    for (const CellTriangle& t : triangles) {
        for (const GridPoint& p : t)
            indices_.push_back(static_cast<uint32_t>(p.y * grid_.width + p.x));
    }
    return pattern;
}

void GeoMipmapFront::add_book(const BlockShape& shape) {
    PatternBook& book = books_.emplace_back();
    book.shape = shape;
    const int top = shape.top_shift();
    std::vector<CellTriangle> triangles;
    for (int shift = 0; shift <= top; ++shift) {
        for (int mask = 0; mask < 16; ++mask) {
            triangles.clear();
            if (shift == top) {
                add_plain(shape, shift, triangles);
            } else {
                add_inner(shape, shift, triangles);
                for (int side = 0; side < 4; ++side)
                    add_strip(shape, side, shift, shift + (mask >> side & 1), triangles);
            }
            book.whole.push_back(add_pattern(triangles));
        }
        triangles.clear();
        add_inner(shape, shift, triangles);
        book.inner.push_back(add_pattern(triangles));
        for (int side = 0; side < 4; ++side) {
            for (int outer = 0; outer <= top; ++outer) {
                triangles.clear();
                if (shift < top && outer >= shift) add_strip(shape, side, shift, outer, triangles);
                book.strip.push_back(add_pattern(triangles));
            }
        }
    }
}

GeoMipmapFront::Stitch GeoMipmapFront::stitch_of(uint32_t block) const {
    Stitch stitch;
    stitch.shift = shift_of(block);
    for (int side = 0; side < 4; ++side) {
        const uint32_t other = blocks().neighbour(block, side);
        int& outer = stitch.outer_shift[side];
        outer = other == BlockGrid::kNoBlock ? stitch.shift : std::max(stitch.shift, shift_of(other));
        if (outer == stitch.shift + 1) stitch.mask |= 1 << side;
        if (outer > stitch.shift + 1) stitch.is_simple = false;
    }
    return stitch;
}

uint32_t GeoMipmapFront::triangles_of(uint32_t block) const {
    const PatternBook& book = book_of(block);
    const Stitch stitch = stitch_of(block);
    if (stitch.is_simple)
        return book.whole[static_cast<size_t>(stitch.shift * 16 + stitch.mask)].index_count / 3;
    uint32_t indices = book.inner[static_cast<size_t>(stitch.shift)].index_count;
    for (int side = 0; side < 4; ++side)
        indices += book.strip_at(stitch.shift, side, stitch.outer_shift[side]).index_count;
    return indices / 3;
}

uint32_t GeoMipmapFront::on_move(uint32_t block, uint32_t from, lod::OperationCounts& operations) {
    const bool is_finer = rung(block) > from;
    ++operations[is_finer ? lod::OperationKind::kClusterRefine : lod::OperationKind::kClusterCoarsen];
    return 1;
}

lod::PoolRegion GeoMipmapFront::pool_need() const {
    const auto samples = static_cast<uint32_t>(grid_.height_m.size());
    return {0, samples, 0, static_cast<uint32_t>(indices_.size())};
}

void GeoMipmapFront::place(const lod::PoolRegion& region) {
    region_ = region;
    vertices_.place();
    are_indices_written_ = false;
}

void GeoMipmapFront::add_items(uint32_t block, uint32_t instance, lod::DrawList& out) {
    const GridPoint at = blocks().origin(block);
    const int32_t base = static_cast<int32_t>(region_.first_vertex) + at.y * grid_.width + at.x;
    const auto add = [&](const Pattern& pattern) {
        if (pattern.index_count == 0) return;
        out.items.push_back(
            {pattern.index_count, region_.first_index + pattern.first_index, base, instance, false});
    };
    const PatternBook& book = book_of(block);
    const Stitch stitch = stitch_of(block);
    if (stitch.is_simple) return add(book.whole[static_cast<size_t>(stitch.shift * 16 + stitch.mask)]);
    add(book.inner[static_cast<size_t>(stitch.shift)]);
    for (int side = 0; side < 4; ++side)
        add(book.strip_at(stitch.shift, side, stitch.outer_shift[side]));
}

void GeoMipmapFront::emit(const lod::View& view, lod::DrawList& out) {
    CHECK(region_.vertex_capacity >= grid_.height_m.size() && region_.index_capacity >= indices_.size());
    if (take_first_view()) {
        vertices_.write(region_.first_vertex, out, [&](std::vector<lod::Vertex>& vertices) {
            vertices.reserve(grid_.height_m.size());
            for (int row = 0; row < grid_.height; ++row) {
                for (int col = 0; col < grid_.width; ++col)
                    vertices.push_back(ground_vertex(grid_, col, row));
            }
        });
        if (!are_indices_written_) out.index_writes.push_back({region_.first_index, indices_});
        are_indices_written_ = true;
    }
    const lod::ViewMetric metric = lod::metric_of(view);
    const auto instance = static_cast<uint32_t>(out.instances.size());
    out.instances.push_back(
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kTerrain));
    uint64_t emitted = 0;
    for (uint32_t block = 0; block < blocks().count(); ++block) {
        if (!sight_of(metric, box(block)).is_visible()) continue;
        add_items(block, instance, out);
        emitted += triangles_of(block);
    }
    set_emitted(emitted);
}

uint64_t GeoMipmapFront::memory_bytes() const {
    return LadderFront::memory_bytes() + indices_.size() * sizeof(uint32_t) + book_.size();
}

}  // namespace terrain
