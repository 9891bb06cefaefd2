#include "data/ground_query.h"

#include <algorithm>
#include <array>

#include "lod/base/check.h"
#include "lod/base/parallel.h"

namespace data {
namespace {

constexpr size_t kBlock = 256;  // places that are transformed at once

GroundKind kind_of(const HeightGrid& grid, const HalfCell& half) {
    bool is_filled = false;
    for (const glm::ivec2& p : {half.corner, half.along_row, half.along_col}) {
        if (grid.void_at(p.x, p.y)) return GroundKind::kVoid;
        is_filled |= grid.filled_at(p.x, p.y);
    }
    return is_filled ? GroundKind::kFilled : GroundKind::kMeasured;
}

/// Upwards; straight up where the triangle has no area, as in a row of samples at a pole.
glm::dvec3 normal_of(const HeightGrid& grid, const HalfCell& half) {
    const auto world = [&](const glm::ivec2& p) {
        return grid.frame.world_from_sample(p.x, p.y, double{grid.at(p.x, p.y)});
    };
    const glm::dvec3 corner = world(half.corner);
    glm::dvec3 normal = glm::cross(world(half.along_col) - corner, world(half.along_row) - corner);
    // Columns run east and rows south: the cross product points up when both ways do, or neither.
    if ((half.along_row.x < half.corner.x) != (half.along_col.y < half.corner.y)) normal = -normal;
    const double length = glm::length(normal);
    if (length > 1e-6) return normal / length;  // m^2
    const double height_m = double{grid.at(half.corner.x, half.corner.y)};
    return glm::normalize(grid.frame.world_from_sample(half.corner.x, half.corner.y, height_m + 1000.0) -
                          corner);
}

/// @param to_grid  takes a block of points to the grid, in place
template <typename Point, typename ToGrid>
void answer(const HeightGrid& grid, std::span<const Point> points, std::span<GroundAnswer> out,
            unsigned threads, const ToGrid& to_grid) {
    CHECK(out.size() == points.size());
    lod::parallel_for(points.size(), threads, [&](size_t begin, size_t end) {
        std::array<glm::dvec3, kBlock> block;
        for (size_t first = begin; first < end; first += kBlock) {
            const size_t count = std::min(kBlock, end - first);
            to_grid(points.subspan(first, count), std::span(block.data(), count));
            for (size_t i = 0; i < count; ++i)
                out[first + i] = ground_at_grid(grid, glm::dvec2(block[i]));
        }
    });
}

}  // namespace

GroundAnswer ground_at_grid(const HeightGrid& grid, const glm::dvec2& place) {
    if (!is_inside(grid, place.x, place.y)) return {};
    const HalfCell half = half_cell_at(grid, place.x, place.y);
    const glm::dvec2 cell = grid.frame.cell_m();
    return {ground_height(grid, place.x, place.y).height_m, normal_of(grid, half), std::max(cell.x, cell.y),
            kind_of(grid, half)};
}

void ground_at_sites(const HeightGrid& grid, std::span<const SitePoint> sites, std::span<GroundAnswer> out,
                     unsigned threads) {
    answer(grid, sites, out, threads, [&](std::span<const SitePoint> in, std::span<glm::dvec3> places) {
        for (size_t i = 0; i < in.size(); ++i)
            places[i] = {in[i].x, in[i].y, 0.0};
        grid.frame.grid_from_sites(places);
    });
}

void ground_under(const HeightGrid& grid, std::span<const glm::dvec3> world, std::span<GroundAnswer> out,
                  unsigned threads) {
    answer(grid, world, out, threads, [&](std::span<const glm::dvec3> in, std::span<glm::dvec3> places) {
        std::copy(in.begin(), in.end(), places.begin());
        grid.frame.grid_from_world(places);
    });
}

GroundAnswer ground_at_site(const HeightGrid& grid, const SitePoint& site) {
    GroundAnswer one;
    ground_at_sites(grid, {&site, 1}, {&one, 1}, 1);
    return one;
}

GroundAnswer ground_under(const HeightGrid& grid, const glm::dvec3& world) {
    GroundAnswer one;
    ground_under(grid, {&world, 1}, {&one, 1}, 1);
    return one;
}

}  // namespace data
