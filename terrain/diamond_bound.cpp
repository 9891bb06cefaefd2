#include "terrain/diamond_bound.h"

#include <algorithm>

namespace terrain {
namespace {

/// The longest cell side anywhere in the raster, metres: along rows, along columns.
glm::dvec2 longest_cell_m(const data::HeightGrid& grid) {
    constexpr int kProbes = 8;
    glm::dvec2 longest(0.0);
    for (int i = 0; i <= kProbes; ++i) {
        for (int j = 0; j <= kProbes; ++j) {
            const int col = (grid.width - 2) * i / kProbes;
            const int row = (grid.height - 2) * j / kProbes;
            const double top = double(grid.max_m);
            const glm::dvec3 here = grid.frame.world_from_sample(col, row, top);
            const glm::dvec3 east = grid.frame.world_from_sample(col + 1, row, top);
            const glm::dvec3 south = grid.frame.world_from_sample(col, row + 1, top);
            longest = glm::max(longest, glm::dvec2(glm::length(east - here), glm::length(south - here)));
        }
    }
    return longest * 1.01;
}

}  // namespace

BoundMaker::BoundMaker(const data::HeightGrid& grid, const Domain& domain)
    : frame_(grid.frame), domain_(domain) {
    const int col = grid.width / 2, row = grid.height / 2;
    anchor_ = frame_.world_from_sample(col, row, double(grid.at(col, row)));
    is_planar_ = !frame_.world().has_datum;
    if (is_planar_) {
        origin_m_ = glm::dvec2(frame_.world_from_sample(0, 0, 0.0));
        column_m_ = glm::dvec2(frame_.world_from_sample(1, 0, 0.0)) - origin_m_;
        row_m_ = glm::dvec2(frame_.world_from_sample(0, 1, 0.0)) - origin_m_;
    }
    const glm::dvec2 cell = longest_cell_m(grid);
    const auto chord = frame_.chord_error_per_cell2();
    for (int level = 0; level <= domain.finest_level() + 1; ++level) {
        const double reach = domain.reach(std::min(level, domain.finest_level()));
        const bool turned = (level & 1) != 0;
        const double straight = reach * (turned ? std::max(cell.x, cell.y) : std::hypot(cell.x, cell.y));
        // Corners are seen along the chord: twice its length, four times its error.
        reach_m_.push_back(static_cast<float>(straight + 8.0 * reach * reach * (chord.up_m + chord.side_m)));
    }
}

}  // namespace terrain
