#include "sim/compare/sorties.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lod/base/rng.h"

namespace sim {
namespace {

constexpr double kPitch_rad = -0.12;
constexpr double kFov_rad = std::numbers::pi / 3.0;
constexpr double kTurn_rad_s = std::numbers::pi / 60.0;
constexpr uint64_t kSeed = 1;

/// Where an eye is and where it looks; the place in fractional samples.
struct Stand {
    glm::dvec2 grid{0.0};
    double height_m = 0.0, heading_rad = 0.0;
};

/// How high above the highest ground on the way the eye flies: twenty cells, over fine rasters more.
double clearance_m(const data::HeightGrid& grid) {
    const glm::dvec2 extent = glm::dvec2(grid.width, grid.height) * grid.frame.cell_m();
    return std::max(20.0 * grid.frame.cell_m().x, std::min(0.05 * std::max(extent.x, extent.y), 1500.0));
}

double highest_m(const data::HeightGrid& grid, const glm::dvec2& at, int radius) {
    const int col = static_cast<int>(std::lround(at.x)), row = static_cast<int>(std::lround(at.y));
    float highest = grid.min_m;
    for (int y = std::max(row - radius, 0); y <= std::min(row + radius, grid.height - 1); ++y) {
        for (int x = std::max(col - radius, 0); x <= std::min(col + radius, grid.width - 1); ++x)
            highest = std::max(highest, grid.at(x, y));
    }
    return static_cast<double>(highest);
}

lod::View view_from(const data::HeightGrid& grid, const SortieOptions& options, const Stand& stand) {
    lod::View view;
    view.eye_world = grid.frame.world_from_grid(stand.grid.x, stand.grid.y, stand.height_m);
    view.eye_from_world = lod::eye_from_attitude(grid.frame.world().world_from_enu(view.eye_world),
                                                 stand.heading_rad, kPitch_rad, 0.0);
    view.fov_y_rad = kFov_rad;
    view.width_px = options.width_px;
    view.height_px = options.height_px;
    return view;
}

/// From a third of the raster towards its south-east, at one height over everything on the way.
std::vector<Stand> fly(const data::HeightGrid& grid, int frames) {
    const glm::dvec2 cell = grid.frame.cell_m();
    std::vector<Stand> stands;
    Stand stand{glm::dvec2(grid.width - 1, grid.height - 1) * 0.3, 0.0, 0.75 * std::numbers::pi};
    for (int frame = 0; frame < frames; ++frame) {
        stands.push_back(stand);
        const double step_m = kSpeed_mps / kRate_hz;
        stand.grid.x += std::sin(stand.heading_rad) * step_m / cell.x;
        stand.grid.y -= std::cos(stand.heading_rad) * step_m / cell.y;
        stand.grid = glm::clamp(stand.grid, glm::dvec2(0.0), glm::dvec2(grid.width - 1, grid.height - 1));
        stand.heading_rad += kTurn_rad_s / kRate_hz;
    }
    double highest = static_cast<double>(grid.min_m);
    for (const Stand& at : stands)
        highest = std::max(highest, highest_m(grid, at.grid, 8));
    for (Stand& at : stands)
        at.height_m = highest + clearance_m(grid);
    return stands;
}

}  // namespace

Sorties plan_sorties(const data::HeightGrid& grid, const SortieOptions& options) {
    Sorties sorties;
    const std::vector<Stand> flight = fly(grid, options.frames);
    for (const Stand& stand : flight)
        sorties.flight.push_back(view_from(grid, options, stand));
    Stand turning = flight.back();
    lod::Rng rng(kSeed);
    for (int i = 0; i < options.incoherent; ++i) {
        turning.heading_rad += std::numbers::pi;
        sorties.turns.push_back(view_from(grid, options, turning));
        Stand there;
        there.grid = {rng.between(0.1, 0.9) * (grid.width - 1), rng.between(0.1, 0.9) * (grid.height - 1)};
        there.height_m = highest_m(grid, there.grid, 8) + clearance_m(grid);
        there.heading_rad = rng.between(0.0, 2.0 * std::numbers::pi);
        sorties.teleports.push_back(view_from(grid, options, there));
    }
    return sorties;
}

std::vector<lod::View> calibration_views(const Sorties& sorties) {
    return {sorties.flight.front(), sorties.flight[sorties.flight.size() / 2], sorties.flight.back()};
}

}  // namespace sim
