#include "data/relief_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/ground_height.h"
#include "lod/base/check.h"

namespace data {
namespace {

/// Distances along the ground from a place, by the steps between the samples around it.
class GroundDistance {
  public:
    GroundDistance(const HeightGrid& grid, const glm::dvec2& centre) : centre_(centre) {
        const glm::ivec2 last(grid.width - 2, grid.height - 2);
        const glm::ivec2 at = glm::clamp(glm::ivec2(glm::clamp(centre, -1.0, 1e6)), glm::ivec2(0), last);
        const double height_m = double{grid.at(at.x, at.y)};
        const glm::dvec3 here = grid.frame.world_from_sample(at.x, at.y, height_m);
        column_m_ = grid.frame.world_from_sample(at.x + 1, at.y, height_m) - here;
        row_m_ = grid.frame.world_from_sample(at.x, at.y + 1, height_m) - here;
    }

    double operator()(int col, int row) const {
        return glm::length((col - centre_.x) * column_m_ + (row - centre_.y) * row_m_);
    }
    /// Samples that may be this near.
    SampleRange within(double distance_m, const HeightGrid& grid) const {
        // The cell may be skewed: what counts is how far the other axis takes a step away from the line.
        const double area = glm::length(glm::cross(column_m_, row_m_));
        const glm::dvec2 reach(distance_m * glm::length(row_m_) / area,
                               distance_m * glm::length(column_m_) / area);
        const glm::dvec2 last(grid.width - 1, grid.height - 1);
        const glm::dvec2 min = glm::max(glm::ceil(centre_ - reach), glm::dvec2(0.0));
        const glm::dvec2 max = glm::min(glm::floor(centre_ + reach), last);
        if (!(min.x <= max.x && min.y <= max.y)) return {};
        return {glm::ivec2(min), glm::ivec2(max)};
    }

  private:
    glm::dvec2 centre_;
    glm::dvec3 column_m_{0.0}, row_m_{0.0};
};

/// The part of a range whose heights differ from the grid's.
HeightBlock trimmed(const HeightGrid& grid, const SampleRange& range, const std::vector<float>& height_m) {
    HeightBlock block;
    block.range = {{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()}, {-1, -1}};
    const auto at = [&](int col, int row) {
        return height_m[static_cast<size_t>(row - range.min.y) * static_cast<size_t>(range.columns()) +
                        static_cast<size_t>(col - range.min.x)];
    };
    for (int row = range.min.y; row <= range.max.y; ++row) {
        for (int col = range.min.x; col <= range.max.x; ++col) {
            if (grid.void_at(col, row) || at(col, row) == grid.at(col, row)) continue;
            block.range.min = glm::min(block.range.min, glm::ivec2(col, row));
            block.range.max = glm::max(block.range.max, glm::ivec2(col, row));
        }
    }
    block.height_m.reserve(block.range.count());
    for (int row = block.range.min.y; row <= block.range.max.y; ++row) {
        for (int col = block.range.min.x; col <= block.range.max.x; ++col)
            block.height_m.push_back(at(col, row));
    }
    return block;
}

/// @param height_at  (column, row) to the new height
template <typename HeightAt>
HeightBlock block_of(const HeightGrid& grid, const SampleRange& range, const HeightAt& height_at) {
    std::vector<float> height_m;
    height_m.reserve(range.count());
    for (int row = range.min.y; row <= range.max.y; ++row) {
        for (int col = range.min.x; col <= range.max.x; ++col)
            height_m.push_back(height_at(col, row));
    }
    return trimmed(grid, range, height_m);
}

/// Metres above the ground as it was. @param r  distance in radii
double crater_rise_m(const Crater& crater, double r) {
    if (r < 1.0) return crater.rim_m - (crater.depth_m + crater.rim_m) * (1.0 - r * r);
    const double rest = std::max(2.0 - r, 0.0);
    return crater.rim_m * rest * rest * rest;
}

/// A height of the other grid's surface; a place within a millionth of a cell of a sample is the sample.
GroundHeight height_of(const HeightGrid& other, const SitePoint& site) {
    const glm::dvec2 place = other.frame.grid_from_site(site);
    const glm::dvec2 whole = glm::round(place);
    const bool coincides = std::abs(place.x - whole.x) < 1e-6 && std::abs(place.y - whole.y) < 1e-6;
    if (!coincides || !is_inside(other, whole.x, whole.y)) return ground_height(other, place.x, place.y);
    const glm::ivec2 at(whole);
    return {double{other.at(at.x, at.y)}, !other.void_at(at.x, at.y)};
}

/// Samples of a grid that may lie on another one: around the places of the other's border.
SampleRange meeting(const HeightGrid& grid, const HeightGrid& other) {
    constexpr int kProbes = 64;  // a side; borders are nearly straight between them
    glm::dvec2 min(std::numeric_limits<double>::infinity()), max(-min);
    for (int i = 0; i <= kProbes; ++i) {
        const double col = (other.width - 1) * (double(i) / kProbes);
        const double row = (other.height - 1) * (double(i) / kProbes);
        const glm::dvec2 border[] = {
            {col, 0.0}, {col, other.height - 1.0}, {0.0, row}, {other.width - 1.0, row}};
        for (const glm::dvec2& at : border) {
            const glm::dvec2 place = grid.frame.grid_from_site(other.frame.site_from_grid(at.x, at.y));
            if (!std::isfinite(place.x + place.y)) continue;
            min = glm::min(min, place);
            max = glm::max(max, place);
        }
    }
    const glm::dvec2 slack = 2.0 + 0.01 * glm::max(max - min, 0.0);
    const glm::dvec2 last(grid.width - 1, grid.height - 1);
    min = glm::max(min - slack, glm::dvec2(0.0));
    max = glm::min(max + slack, last);
    if (!(min.x <= max.x && min.y <= max.y)) return {};
    return {glm::ivec2(min), glm::ivec2(max)};
}

}  // namespace

void exchange(HeightGrid& grid, HeightBlock& block) {
    const SampleRange& range = block.range;
    CHECK(block.height_m.size() == range.count());
    if (range.is_empty()) return;
    CHECK(common(range, range_of(grid)).count() == range.count());
    size_t next = 0;
    for (int row = range.min.y; row <= range.max.y; ++row) {
        for (int col = range.min.x; col <= range.max.x; ++col) {
            float& other_m = block.height_m[next++];
            if (grid.void_at(col, row)) continue;
            std::swap(grid.height_m[grid.index(col, row)], other_m);
            const float now_m = grid.at(col, row);
            grid.min_m = std::min(grid.min_m, now_m);
            grid.max_m = std::max(grid.max_m, now_m);
        }
    }
}

HeightBlock make_block(const HeightGrid& grid, const Crater& crater) {
    CHECK(crater.radius_m > 0.0);
    const GroundDistance distance_m(grid, crater.centre_grid);
    const SampleRange range = distance_m.within(2.0 * crater.radius_m, grid);
    return block_of(grid, range, [&](int col, int row) {
        const double rise_m = crater_rise_m(crater, distance_m(col, row) / crater.radius_m);
        return static_cast<float>(double{grid.at(col, row)} + rise_m);
    });
}

HeightBlock make_block(const HeightGrid& grid, const Excavation& excavation) {
    CHECK(excavation.radius_m > 0.0 && excavation.slope_rad > 0.0);
    const GroundHeight middle = ground_height(grid, excavation.centre_grid.x, excavation.centre_grid.y);
    if (!is_inside(grid, excavation.centre_grid.x, excavation.centre_grid.y)) return {};
    const double floor_m = middle.height_m - excavation.depth_m, rise = std::tan(excavation.slope_rad);
    const GroundDistance distance_m(grid, excavation.centre_grid);
    const double slope_m = std::max(double{grid.max_m} - floor_m, 0.0) / rise;
    const SampleRange range = distance_m.within(excavation.radius_m + slope_m, grid);
    return block_of(grid, range, [&](int col, int row) {
        const double beyond_m = std::max(distance_m(col, row) - excavation.radius_m, 0.0);
        return std::min(grid.at(col, row), static_cast<float>(floor_m + beyond_m * rise));
    });
}

HeightBlock make_block(const HeightGrid& grid, const HeightGrid& other) {
    return block_of(grid, meeting(grid, other), [&](int col, int row) {
        const GroundHeight there = height_of(other, grid.frame.site_from_grid(col, row));
        return there.valid ? static_cast<float>(there.height_m) : grid.at(col, row);
    });
}

}  // namespace data
