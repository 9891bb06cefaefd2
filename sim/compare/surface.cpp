#include "sim/compare/surface.h"

#include <cmath>
#include <limits>
#include <mutex>

#include "lod/base/parallel.h"

namespace sim {

SamplePlace place_of(const data::HeightGrid& grid, int col, int row) {
    const double height_m = static_cast<double>(grid.at(col, row));
    const glm::dvec3 world = grid.frame.world_from_sample(col, row, height_m);
    if (!grid.frame.world().has_datum) return {world, {0.0, 0.0, 1.0}};
    return {world, glm::normalize(grid.frame.world_from_sample(col, row, height_m + 1000.0) - world)};
}

double apart_px(const lod::View& view, const SamplePlace& place, double from_m, double to_m) {
    const double lambda_px = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0));
    const glm::dvec3 at = view.eye_from_world * (place.world - view.eye_world);
    const glm::dvec3 up = view.eye_from_world * place.up;
    const glm::dvec3 from = at + up * from_m, to = at + up * to_m;
    if (-from.z <= view.near_m) return -1.0;
    const glm::dvec2 from_px = glm::dvec2(from) * (lambda_px / -from.z);
    if (std::abs(from_px.x) >= view.width_px / 2.0 || std::abs(from_px.y) >= view.height_px / 2.0)
        return -1.0;
    if (to.z >= 0.0) return std::numeric_limits<double>::infinity();
    return glm::distance(from_px, glm::dvec2(to) * (lambda_px / -to.z));
}

MeasuredError measure_error(const data::HeightGrid& grid, const lod::View& view,
                            const std::vector<terrain::DrawnTriangle>& triangles, unsigned threads) {
    MeasuredError all;
    std::mutex mutex;
    lod::parallel_for(triangles.size(), threads, [&](size_t begin, size_t end) {
        MeasuredError mine;
        for (size_t i = begin; i < end; ++i) {
            for_samples_under(triangles[i], EdgeRule::kBoth, [&](int col, int row) {
                const SamplePlace place = place_of(grid, col, row);
                const double px = apart_px(view, place, 0.0, above_m(triangles[i], place));
                if (px < 0.0) return;
                mine.max_px = std::max(mine.max_px, px);
                ++mine.samples;
            });
        }
        const std::lock_guard lock(mutex);
        all.max_px = std::max(all.max_px, mine.max_px);
        all.samples += mine.samples;
    });
    return all;
}

}  // namespace sim
