#include "terrain/rivals/progressive_block.h"

#include <algorithm>

namespace terrain {
namespace {

void put_in_place(std::array<uint16_t, 3>& corners, uint16_t old_vertex, uint16_t new_vertex) {
    for (uint16_t& corner : corners) {
        if (corner == old_vertex) corner = new_vertex;
    }
}

}  // namespace

uint32_t ProgressiveBlock::move(const Stop& from, const Stop& to) {
    uint32_t fix = from.fixes;
    for (uint32_t i = from.splits; i < to.splits; ++i) {
        const auto vertex = static_cast<uint16_t>(base_vertices + i);
        for (uint32_t k = 0; k < splits[i].fix_count; ++k)
            put_in_place(corners[fixes[fix++]], splits[i].vertex, vertex);
    }
    for (uint32_t i = from.splits; i > to.splits; --i) {
        const auto vertex = static_cast<uint16_t>(base_vertices + i - 1);
        for (uint32_t k = 0; k < splits[i - 1].fix_count; ++k)
            put_in_place(corners[fixes[--fix]], vertex, splits[i - 1].vertex);
    }
    return std::max(from.splits, to.splits) - std::min(from.splits, to.splits);
}

uint64_t ProgressiveBlock::memory_bytes() const {
    return sizeof(*this) + places.size() * sizeof(Place) + corners.size() * sizeof(corners[0]) +
           splits.size() * sizeof(Split) + (fixes.size() + rim_vertex.size()) * sizeof(uint16_t) +
           stops.size() * sizeof(Stop);
}

}  // namespace terrain
