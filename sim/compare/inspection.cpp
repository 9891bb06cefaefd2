#include "sim/compare/inspection.h"

#include <algorithm>

#include "sim/compare/sorties.h"
#include "sim/compare/statistics.h"
#include "sim/compare/surface_history.h"

namespace sim {
namespace {

constexpr size_t kCacheEntries = 16;

}  // namespace

double cache_misses_a_triangle(const terrain::PoolTwin& pool, const lod::DrawList& list, size_t size) {
    std::vector<int64_t> cache(size, -1);
    size_t oldest = 0, misses = 0, corners = 0;
    for (const lod::DrawItem& item : list.items) {
        for (uint32_t i = 0; i < item.index_count; ++i) {
            const uint32_t* triangle = &pool.indices[item.first_index + i / 3 * 3];
            if (triangle[0] == triangle[1]) continue;  // fills a gap between others
            const int64_t vertex = int64_t{pool.indices[item.first_index + i]} + item.base_vertex;
            ++corners;
            if (std::find(cache.begin(), cache.end(), vertex) != cache.end()) continue;
            cache[oldest] = vertex;
            oldest = (oldest + 1) % size;
            ++misses;
        }
    }
    return corners == 0 ? 0.0 : 3.0 * static_cast<double>(misses) / static_cast<double>(corners);
}

uint64_t upload_bytes(const lod::DrawList& list) {
    uint64_t bytes = 0;
    for (const lod::VertexWrite& write : list.vertex_writes)
        bytes += write.vertices.size_bytes();
    for (const lod::IndexWrite& write : list.index_writes)
        bytes += write.indices.size_bytes();
    return bytes;
}

Inspection inspect(Method& method, const data::HeightGrid& grid, std::span<const lod::View> flight,
                   double tolerance_px) {
    SurfaceHistory history(grid);
    std::vector<double> triangles, cut, commands, bytes, shares, acmr;
    Inspection found;
    for (size_t frame = 0; frame < flight.size(); ++frame) {
        adapt(method, flight[frame], static_cast<double>(frame) / kRate_hz, tolerance_px);
        const uint64_t written = upload_bytes(method.list);
        std::vector<terrain::DrawnTriangle> drawn = triangles_of(method);
        triangles.push_back(static_cast<double>(drawn.size()));
        cut.push_back(static_cast<double>(method.front->triangles()));
        commands.push_back(static_cast<double>(method.list.items.size()));
        if (frame % 8 == 0) acmr.push_back(cache_misses_a_triangle(method.pool, method.list, kCacheEntries));
        const SurfaceChange change = history.add(flight[frame], std::move(drawn));
        if (frame == 0) continue;
        bytes.push_back(static_cast<double>(written));
        shares.push_back(change.changed_share);
        found.popping_px = std::max(found.popping_px, change.popping_px);
        found.told_px = std::max(found.told_px, method.front->jump_px());
    }
    found.triangles = mean(triangles);
    found.cut_triangles = mean(cut);
    found.commands = mean(commands);
    found.upload_bytes = mean(bytes);
    found.changed_share = mean(shares);
    found.acmr = mean(acmr);
    return found;
}

}  // namespace sim
