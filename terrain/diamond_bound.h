// DiamondBound: the sphere that contains a diamond's two triangles, every sample they cover, and their error.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "data/ground_frame.h"
#include "lod/sight_metric.h"
#include "terrain/diamond_mesh.h"
#include "terrain/diamond_table.h"

namespace terrain {

/// Metres, relative to the terrain's anchor.
using DiamondBound = lod::ErrorSphere;

/// What a bound is made of.
struct BoundFacts {
    const Diamond* diamond = nullptr;
    const DiamondSource* source = nullptr;
};

/// Makes bounds on the fly, from a record and eight bytes of the table; nothing is stored per diamond.
class BoundMaker {
  public:
    explicit BoundMaker(const DiamondTable& table);

    const glm::dvec3& anchor_world() const { return anchor_; }

    /// Cost: about 10 ns.
    DiamondBound operator()(const Diamond& d, const DiamondSource& source) const {
        DiamondBound bound;
        bound.centre = place_m(domain_.clamped(d.centre()), source.height_m);
        const int reach_cells = domain_.reach(d.level);
        const bool is_astride =
            int(d.x) + reach_cells >= clamped_from_.x || int(d.y) + reach_cells >= clamped_from_.y;
        bound.error_m = source.error_m() * (is_astride ? kAstride : 1.0f);
        const float rise = source.rise_m();
        const float reach = reach_m_[d.level];
        const float rounding =
            (std::abs(bound.centre.x) + std::abs(bound.centre.y) + std::abs(bound.centre.z)) * kRounding;
        bound.radius_m =
            (std::sqrt(reach * reach + rise * rise) + bound.error_m + rounding) * (1.0f + 0x1p-20f);
        return bound;
    }

    /// Four at a time, to the same bits. Cost: about 10 ns (terrain_bench).
    lod::FourBounds operator()(const std::array<BoundFacts, 4>& of) const {
        using lod::Float4, lod::Int4;
        lod::FourBounds bound;
        Int4 column{}, row{}, codes{}, reach_cells{};
        Float4 height{}, reach{};
        for (size_t lane = 0; lane < 4; ++lane) {
            const Diamond& d = *of[lane].diamond;
            column[lane] = d.x;
            row[lane] = d.y;
            reach[lane] = reach_m_[d.level];
            reach_cells[lane] = domain_.reach(d.level);
            height[lane] = of[lane].source->height_m;
            codes[lane] = of[lane].source->error_code | of[lane].source->rise_code() << 16;
        }
        place_m(column, row, height, bound);
        const Int4 is_astride =
            (column + reach_cells >= clamped_from_.x) | (row + reach_cells >= clamped_from_.y);
        bound.error_m = decode_lengths(codes & 0xffff);
        bound.error_m = is_astride ? bound.error_m * kAstride : bound.error_m;
        const Float4 rise = decode_lengths((codes >> 16) & 0xffff);
        const Float4 rounding = (lod::abs(bound.x) + lod::abs(bound.y) + lod::abs(bound.z)) * kRounding;
        bound.radius_m =
            (lod::sqrt(reach * reach + rise * rise) + bound.error_m + rounding) * (1.0f + 0x1p-20f);
        return bound;
    }

  private:
    /// Half of it for the place, half for the metric's own roundings.
    static constexpr float kRounding = 0x1p-21f;
    /// Of errors astride the raster's border: where vertices are clamped off their edges a split changes a diagonal at
    /// once, which no glide hides; it is to come while it is half as large.
    static constexpr float kAstride = 2.0f;

    glm::vec3 place_m(GridPoint p, float height_m) const {
        if (!is_upright_) return glm::vec3(frame_.world_from_sample(p.x, p.y, double(height_m)) - anchor_);
        return {cell_x_m_ * static_cast<float>(p.x - middle_.x),
                cell_y_m_ * static_cast<float>(p.y - middle_.y), height_m - middle_height_m_};
    }
    void place_m(lod::Int4 column, lod::Int4 row, lod::Float4 height_m, lod::FourBounds& out) const {
        const int32_t last_column = domain_.width - 1, last_row = domain_.height - 1;
        column = column < last_column ? column : lod::Int4{} + last_column;
        row = row < last_row ? row : lod::Int4{} + last_row;
        if (is_upright_) {
            out.x = cell_x_m_ * __builtin_convertvector(column - middle_.x, lod::Float4);
            out.y = cell_y_m_ * __builtin_convertvector(row - middle_.y, lod::Float4);
            out.z = height_m - middle_height_m_;
            return;
        }
        for (int lane = 0; lane < 4; ++lane) {
            const glm::vec3 place = place_m({column[lane], row[lane]}, height_m[lane]);
            out.x[lane] = place.x, out.y[lane] = place.y, out.z[lane] = place.z;
        }
    }

    data::GroundFrame frame_;
    Domain domain_;
    GridPoint
        clamped_from_;  ///< first column and row of the domain beyond the raster; far away where there is none
    glm::dvec3 anchor_{0.0};  ///< of the sample in the middle, halfway up
    /// A plane whose rows and columns run along its axes: then products of single precision are good enough.
    bool is_upright_ = false;
    float cell_x_m_ = 0.0f, cell_y_m_ = 0.0f;
    GridPoint middle_;
    float middle_height_m_ = 0.0f;
    std::vector<float> reach_m_;  ///< [level] centre to corner, horizontally, upper bound
};

}  // namespace terrain
