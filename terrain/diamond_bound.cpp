#include "terrain/diamond_bound.h"

#include <algorithm>

namespace terrain {
namespace {

/// The longest cell side anywhere in the raster, metres: along rows, along columns.
glm::dvec2 longest_cell_m(const DiamondTable& table) {
    constexpr int kProbes = 8;
    glm::dvec2 longest(0.0);
    for (int i = 0; i <= kProbes; ++i) {
        for (int j = 0; j <= kProbes; ++j) {
            const int col = (table.domain.width - 2) * i / kProbes;
            const int row = (table.domain.height - 2) * j / kProbes;
            const double top = double(table.max_m);
            const glm::dvec3 here = table.frame.world_from_sample(col, row, top);
            const glm::dvec3 east = table.frame.world_from_sample(col + 1, row, top);
            const glm::dvec3 south = table.frame.world_from_sample(col, row + 1, top);
            longest = glm::max(longest, glm::dvec2(glm::length(east - here), glm::length(south - here)));
        }
    }
    return longest * 1.01;
}

}  // namespace

BoundMaker::BoundMaker(const DiamondTable& table) : frame_(table.frame), domain_(table.domain) {
    const Domain& domain = table.domain;
    constexpr int kNowhere = 1 << 30;
    clamped_from_ = {domain.width > domain.side() ? kNowhere : domain.width,
                     domain.height > domain.side() ? kNowhere : domain.height};
    middle_ = {domain.width / 2, domain.height / 2};
    middle_height_m_ = static_cast<float>(0.5 * (double(table.min_m) + double(table.max_m)));
    anchor_ = frame_.world_from_sample(middle_.x, middle_.y, double(middle_height_m_));
    if (!frame_.world().has_datum) {
        const glm::dvec2 origin(frame_.world_from_sample(0, 0, 0.0));
        const glm::dvec2 column = glm::dvec2(frame_.world_from_sample(1, 0, 0.0)) - origin;
        const glm::dvec2 row = glm::dvec2(frame_.world_from_sample(0, 1, 0.0)) - origin;
        cell_x_m_ = static_cast<float>(column.x);
        cell_y_m_ = static_cast<float>(row.y);
        is_upright_ = column.y == 0.0 && row.x == 0.0;
    }
    const glm::dvec2 cell = longest_cell_m(table);
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
