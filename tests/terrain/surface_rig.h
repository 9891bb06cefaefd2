// A terrain front that is drawn every frame, and how far the surface it draws moves over the samples of its raster.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/drawn_mesh.h"

namespace terrain_test {

/// Heights of the drawn surface over every sample; NaN where nothing is drawn.
inline std::vector<double> drawn_heights(const data::HeightGrid& grid,
                                         std::span<const DrawnTriangle> triangles) {
    std::vector<double> heights(grid.height_m.size(), std::nan(""));
    for (const DrawnTriangle& t : triangles)
        for_each_sample(t,
                        [&](int x, int y, const glm::dvec3& point) { heights[grid.index(x, y)] = point.z; });
    return heights;
}

/// Over a grid in a plane.
struct SurfaceRig {
    SurfaceRig(const data::HeightGrid& over, double tolerance, double glide_s)
        : grid(over),
          tolerance_px(tolerance),
          front(terrain::make_diamond_table(over, 2),
                {.tolerance_px = tolerance, .reserve_triangles = 60'000, .glide_s = glide_s}) {}

    void frame(const lod::View& view, double time_s, uint64_t operations = UINT64_MAX) {
        lod::Front* fronts[] = {&front};
        front.begin_frame({&view, 1}, time_s);
        lod::schedule(fronts, {.tolerance_px = tolerance_px}, lod::operation_limit(operations));
        if (front.pool_need().index_capacity > placed.index_capacity ||
            front.pool_need().vertex_capacity > placed.vertex_capacity) {
            placed = front.pool_need();
            front.place(placed);
        }
        lod::DrawList list;
        front.emit(view, list);
        pool.apply(list);
        before = std::move(now);
        metric_before = std::exchange(metric_now, lod::metric_of(view));
        triangles = drawn_triangles(pool, list, lod::Module::kTerrain);
        now = drawn_heights(grid, triangles);
    }

    /// The farthest the surface over any sample in view, now and in the last frame, has moved since then, px.
    double moved_px() const {
        const lod::ViewMetric& metric = metric_now;
        double worst = 0.0;
        for (int y = 0; y < grid.height; ++y) {
            for (int x = 0; x < grid.width; ++x) {
                const size_t i = grid.index(x, y);
                if (!(now[i] != before[i])) continue;
                if (std::isnan(now[i]) || std::isnan(before[i])) continue;
                const glm::dvec3 at = grid.frame.world_from_sample(x, y, now[i]);
                const glm::dvec3 eye = seen_from(metric, at);
                if (lod::distance_outside_m(metric, eye, 0.0) > 0.0) continue;
                const glm::dvec3 then(at.x, at.y, before[i]);
                if (lod::distance_outside_m(metric_before, seen_from(metric_before, then), 0.0) > 0.0)
                    continue;
                const glm::dvec3 was = seen_from(metric, then);
                const glm::dvec2 shift = glm::dvec2(eye) / -eye.z - glm::dvec2(was) / -was.z;
                worst = std::max(worst, metric.lambda_px * glm::length(shift));
            }
        }
        return worst;
    }

    /// The farthest the surface over any sample in view is shown from the sample, px.
    double off_px() const {
        double worst = 0.0;
        for (int y = 0; y < grid.height; ++y) {
            for (int x = 0; x < grid.width; ++x) {
                const size_t i = grid.index(x, y);
                if (std::isnan(now[i])) continue;
                const glm::dvec3 shown = seen_from(metric_now, grid.frame.world_from_sample(x, y, now[i]));
                if (lod::distance_outside_m(metric_now, shown, 0.0) > 0.0) continue;
                const glm::dvec3 is =
                    seen_from(metric_now, grid.frame.world_from_sample(x, y, double(grid.height_m[i])));
                const glm::dvec2 shift = glm::dvec2(shown) / -shown.z - glm::dvec2(is) / -is.z;
                worst = std::max(worst, metric_now.lambda_px * glm::length(shift));
            }
        }
        return worst;
    }

    static glm::dvec3 seen_from(const lod::ViewMetric& metric, const glm::dvec3& world) {
        return metric.eye_from_world * (world - metric.eye_world);
    }

    const data::HeightGrid& grid;
    double tolerance_px;
    terrain::RoamFront front;
    PoolTwin pool;
    lod::PoolRegion placed;
    lod::ViewMetric metric_now, metric_before;
    std::vector<DrawnTriangle> triangles;
    std::vector<double> now, before;
};

}  // namespace terrain_test
