#include "sim/compare/requirements.h"

#include <algorithm>
#include <cmath>

#include "lod/scheduler.h"
#include "sim/compare/surface_history.h"
#include "terrain/drawn/conformity.h"

namespace sim {
namespace {

constexpr int kSpikeSide = 257;
constexpr double kSpikeCells = 16.0;
constexpr double kSpikeTolerance_px = 1.0;

/// The farthest a drawn vertex lies from the sample it takes its colour from, level, in cells.
double colour_beside_cells(const data::HeightGrid& grid,
                           const std::vector<terrain::DrawnTriangle>& triangles) {
    const double cell_m = grid.frame.cell_m().x;
    double worst = 0.0;
    for (const terrain::DrawnTriangle& triangle : triangles) {
        for (size_t i = 0; i < 3; ++i) {
            const terrain::GridPoint at = triangle.samples[i];
            const double height_m = static_cast<double>(grid.at(at.x, at.y));
            const glm::dvec3 foot = grid.frame.world_from_sample(at.x, at.y, height_m);
            const glm::dvec3 above = grid.frame.world_from_sample(at.x, at.y, height_m + 1000.0);
            const glm::dvec3 up = glm::normalize(above - foot), way = triangle.world[i] - foot;
            worst = std::max(worst, glm::length(way - up * glm::dot(way, up)) / cell_m);
        }
    }
    return worst;
}

/// At half of the triangles the front has now: how far from that the scheduler ends.
double off_limit_share(Method& method, double tolerance_px) {
    lod::Front* fronts[] = {method.front.get()};
    const uint64_t limit = std::max<uint64_t>(method.front->triangles() / 2, 1);
    lod::schedule(fronts, {.tolerance_px = tolerance_px, .max_triangles = limit},
                  lod::operation_limit(20 * limit + 20000));
    const double count = static_cast<double>(method.front->triangles());
    return std::abs(count / static_cast<double>(limit) - 1.0);
}

/// A planar square of the raster's heights.
data::HeightGrid square_of(const data::HeightGrid& grid, bool has_spike) {
    const int side = std::min({kSpikeSide, grid.width, grid.height});
    const int left = (grid.width - side) / 2, top = (grid.height - side) / 2;
    const double cell_m = grid.frame.cell_m().x;
    std::vector<float> heights;
    for (int row = 0; row < side; ++row) {
        for (int col = 0; col < side; ++col)
            heights.push_back(grid.at(left + col, top + row));
    }
    const auto middle = static_cast<size_t>(side / 2);
    // Odd in both: the finest level of every hierarchy has to be reached.
    if (has_spike)
        heights[(middle | 1) * static_cast<size_t>(side) + (middle | 1)] +=
            static_cast<float>(kSpikeCells * cell_m);
    return data::make_planar_grid(side, side, cell_m, std::move(heights));
}

std::vector<terrain::DrawnTriangle> picture_of(const std::string& name, const data::HeightGrid& grid,
                                               const MethodOptions& options, const lod::View& view) {
    const terrain::DiamondTable table = terrain::make_diamond_table(grid, options.threads);
    MethodOptions own = options;
    own.only = {name};
    std::vector<Method> methods = make_methods(grid, table, 0.0, own);
    if (methods.empty()) return {};
    restart(methods[0], kSpikeTolerance_px, 0);
    adapt(methods[0], view, 0.0, kSpikeTolerance_px);
    return triangles_of(methods[0]);
}

}  // namespace

PictureFigures measure_picture(Method& method, const data::HeightGrid& grid, const lod::View& view,
                               double tolerance_px) {
    restart(method, tolerance_px, 0);
    adapt(method, view, 0.0, tolerance_px);
    const std::vector<terrain::DrawnTriangle> triangles = triangles_of(method);
    PictureFigures figures;
    figures.t_junctions =
        static_cast<double>(terrain::drawn::count_t_junctions(terrain::drawn::without_skirts(triangles)));
    figures.colour_beside_cells = colour_beside_cells(grid, triangles);
    figures.off_limit_share = off_limit_share(method, tolerance_px);
    return figures;
}

double measure_spike(const std::string& method_name, const data::HeightGrid& grid,
                     const MethodOptions& options) {
    const data::HeightGrid plain = square_of(grid, false), spiked = square_of(grid, true);
    const double extent_m = (plain.width - 1) * plain.frame.cell_m().x;
    lod::View optics;
    optics.width_px = 1280;
    optics.height_px = 720;
    const glm::dvec3 eye(0.0, 0.0, static_cast<double>(plain.max_m) + 2.0 * extent_m);
    const glm::dvec3 target(extent_m / 2.0, extent_m / 2.0, static_cast<double>(plain.min_m));
    const lod::View view = lod::look_at(eye, target, {0.0, 0.0, 1.0}, optics);
    auto before = picture_of(method_name, plain, options, view);
    auto after = picture_of(method_name, spiked, options, view);
    if (before.empty() || after.empty()) return -1.0;
    const double count = static_cast<double>(after.size());
    SurfaceHistory history(plain);
    history.add(view, std::move(before));
    return std::round(history.add(view, std::move(after)).changed_share * count);
}

}  // namespace sim
