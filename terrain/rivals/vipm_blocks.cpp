#include "terrain/rivals/vipm_blocks.h"

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/rivals/border_fan.h"

namespace terrain {

VipmBlocks::VipmBlocks(const data::HeightGrid& grid, int cells, unsigned threads)
    : LadderFront(grid, make_block_grid(grid.width, grid.height, cells)),
      meshes_(blocks().count()),
      slots_(blocks().count()),
      is_dirty_(blocks().count(), 1) {
    CHECK(cells >= 2 && cells <= 64 && (cells & (cells - 1)) == 0);
    lod::parallel_for(meshes_.size(), threads, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto block = static_cast<uint32_t>(i);
            meshes_[i] = make_progressive_block(grid, blocks().origin(block), blocks().size(block));
        }
    });
    Ladders ladders;
    uint64_t vertices = 0;
    for (const ProgressiveBlock& mesh : meshes_) {
        std::vector<Rung> rungs;
        for (const Stop& one : mesh.stops)
            rungs.push_back({one.error_m, {}});
        ladders.add(rungs);
        first_vertex_.push_back(static_cast<uint32_t>(vertices));
        vertices += mesh.places.size();
    }
    CHECK(vertices <= INT32_MAX);
    first_vertex_.push_back(static_cast<uint32_t>(vertices));
    start(std::move(ladders));
    for (uint32_t block = 0; block < blocks().count(); ++block)
        fit_slot(block);
}

/// The finer of both blocks' borders, side by side.
std::array<uint8_t, 4> VipmBlocks::border_of(uint32_t block) const {
    std::array<uint8_t, 4> shift = stop(block).border_shift;
    for (int side = 0; side < 4; ++side) {
        const uint32_t other = blocks().neighbour(block, side);
        if (other == BlockGrid::kNoBlock) continue;
        const auto s = static_cast<size_t>(side);
        shift[s] = std::min(shift[s], stop(other).border_shift[s ^ 2]);
    }
    return shift;
}

/// Every vertex that a fan adds to the border adds one triangle.
uint32_t VipmBlocks::triangles_of(uint32_t block) const {
    const Stop& at = stop(block);
    const std::array<uint8_t, 4> shift = border_of(block);
    const GridPoint size = meshes_[block].size;
    uint32_t count = at.triangles;
    for (size_t side = 0; side < 4; ++side) {
        const int between = (side & 1) == 0 ? size.x - 1 : size.y - 1;
        count += static_cast<uint32_t>(between >> shift[side]) - at.border_points[side];
    }
    return count;
}

void VipmBlocks::fit_slot(uint32_t block) {
    const uint32_t most = stop(block).triangles + 4 * static_cast<uint32_t>(blocks().cells);
    slot_pool_.fit(slots_[block], 3 * most);
}

uint32_t VipmBlocks::on_move(uint32_t block, uint32_t from, lod::OperationCounts& operations) {
    const Stop &before = meshes_[block].stops[from], &now = stop(block);
    const uint32_t steps = meshes_[block].move(before, now);
    operations[rung(block) > from ? lod::OperationKind::kVsplit : lod::OperationKind::kEcol] += steps;
    is_dirty_[block] = 1;
    for (int side = 0; side < 4; ++side) {
        const uint32_t other = blocks().neighbour(block, side);
        const auto s = static_cast<size_t>(side);
        if (other != BlockGrid::kNoBlock && before.border_shift[s] != now.border_shift[s])
            is_dirty_[other] = 1;
    }
    fit_slot(block);
    return steps;
}

lod::PoolRegion VipmBlocks::pool_need() const {
    return {0, first_vertex_.back(), 0, slot_pool_.top()};
}

void VipmBlocks::place(const lod::PoolRegion& region) {
    region_ = region;
    vertices_.place();
    is_dirty_.assign(is_dirty_.size(), 1);
}

/// Appends a block's indices to the staging buffer.
void VipmBlocks::stage(uint32_t block) {
    const ProgressiveBlock& mesh = meshes_[block];
    const std::array<uint8_t, 4> shift = border_of(block);
    const size_t begin = staging_.size();
    const auto vertex_at = [&](GridPoint p) {
        const int side = common_side(mesh.size, p, p);
        return uint32_t{mesh.vertex_on_side(side, along_side(side, p))};
    };
    for (uint32_t i = 0; i < stop(block).triangles; ++i) {
        const std::array<uint16_t, 3>& c = mesh.corners[i];
        const CellTriangle t{mesh.place(c[0]), mesh.place(c[1]), mesh.place(c[2])};
        const auto emit = [&](const CellTriangle& part) {
            for (const GridPoint& p : part) {
                const auto known = std::find(t.begin(), t.end(), p);
                staging_.push_back(known != t.end() ? c[static_cast<size_t>(known - t.begin())]
                                                    : vertex_at(p));
            }
        };
        fan_border(mesh.size, t, shift, emit);
    }
    writes_.push_back({region_.first_index + slots_[block].first, begin, staging_.size()});
    CHECK(staging_.size() - begin == 3 * triangles_of(block));
    is_dirty_[block] = 0;
}

void VipmBlocks::write(lod::DrawList& out) {
    vertices_.write(region_.first_vertex, out, [&](std::vector<lod::Vertex>& vertices) {
        vertices.reserve(first_vertex_.back());
        for (const ProgressiveBlock& mesh : meshes_) {
            for (const ProgressiveBlock::Place& p : mesh.places)
                vertices.push_back(ground_vertex(grid_, mesh.origin.x + p.x, mesh.origin.y + p.y));
        }
    });
    staging_.clear();
    writes_.clear();
    for (uint32_t block = 0; block < blocks().count(); ++block) {
        if (is_visible(block) && is_dirty_[block] != 0) stage(block);
    }
    for (const Write& one : writes_)
        out.index_writes.push_back({one.first_index, {&staging_[one.begin], one.end - one.begin}});
}

void VipmBlocks::emit(const lod::View& view, lod::DrawList& out) {
    CHECK(region_.vertex_capacity >= first_vertex_.back() && region_.index_capacity >= slot_pool_.top());
    if (take_first_view()) write(out);
    const lod::ViewMetric metric = lod::metric_of(view);
    const auto instance = static_cast<uint32_t>(out.instances.size());
    out.instances.push_back(
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kTerrain));
    uint64_t emitted = 0;
    for (uint32_t block = 0; block < blocks().count(); ++block) {
        if (!is_visible(block) || !sight_of(metric, box(block)).is_visible()) continue;
        const uint32_t triangles = triangles_of(block);
        out.items.push_back({3 * triangles, region_.first_index + slots_[block].first,
                             static_cast<int32_t>(region_.first_vertex + first_vertex_[block]), instance,
                             false});
        emitted += triangles;
    }
    set_emitted(emitted);
}

uint64_t VipmBlocks::memory_bytes() const {
    uint64_t bytes = LadderFront::memory_bytes();
    for (const ProgressiveBlock& mesh : meshes_)
        bytes += mesh.memory_bytes();
    return bytes + meshes_.size() * (sizeof(uint32_t) + sizeof(SlotPool::Slot) + 1) +
           staging_.capacity() * sizeof(uint32_t);
}

}  // namespace terrain
