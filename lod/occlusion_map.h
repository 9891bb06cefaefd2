// OcclusionMap: which pixels of a picture are covered by convex solids and triangles, and how far away these are at the
// most: what lies behind them as a whole need neither be refined nor drawn.
//
//     cell   8 x 8 pixels:   covered  a bit a pixel, by what came so far       part_depth  the farthest of these
//                            full_depth  the nearest depth in front of which all 64 are known to be covered
//
// A pixel counts as covered when its centre lies inside the outline of one of them, a 64th of a pixel from its edge at
// least: then a rasteriser that puts its corners on 1/256 pixel covers it, too. So leaving out what is hidden changes no
// pixel of a picture in which what covers is drawn itself.
//
// Source: the cells are those of Hasselgren, Andersson, Akenine-Moeller, Masked software occlusion culling (2016), with
// one depth a solid or triangle.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/view.h"

namespace lod {

/// Where a point shows: pixels from the picture's lower left corner, which may lie outside, and metres along the line of
/// sight, > 0.
struct PicturePoint {
    float x_px = 0.0f, y_px = 0.0f;
    float depth_m = 0.0f;
};

/// Pixels first … last, inside the picture.
struct PixelRectangle {
    int left = 0, right = 0;
    int bottom = 0, top = 0;
};

class OcclusionMap {
  public:
    static constexpr size_t kMostCorners = 16;

    /// Empties the map for a picture. Cost: 16 bytes for each 64 pixels.
    void begin(const ViewMetric& metric, int width_px, int height_px);

    /// Adds the convex hull of 3 to kMostCorners points. Nothing when one of them is nearer than the near plane, or when
    /// it is less than 3 px high. Most is hidden in the end when what is near comes first.
    /// @param corners_eye  eye frame (-z ahead), metres
    /// Cost: its rows, and the cells they meet.
    void add_convex(std::span<const glm::dvec3> corners_eye);

    /// Adds a triangle, either way round, whose corners lie less than 8,192 px from the picture's lower left one; others
    /// are left out. Cost: as above, 40 ns at least.
    void add_triangle(const std::array<PicturePoint, 3>& corners);

    /// Whether all that was added covers every pixel that the hull of some points may touch, all of it nearer. Never of what
    /// reaches through the near plane or lies outside the picture.
    /// @param corners_eye  at least one; as above
    bool hides(std::span<const glm::dvec3> corners_eye) const;
    /// The same of what shows on these pixels only, at `nearest_m` or farther.
    bool hides(const PixelRectangle& pixels, float nearest_m) const;

    /// How far from a pixel's centre an edge must stay for it to be certain on which side the centre is.
    static constexpr double kMargin_px = 1.0 / 64.0;
    static constexpr double kDepthSlack = 1e-5;  ///< of a depth: positions are rounded when they are drawn

  private:
    struct Cell {
        uint64_t covered = 0;
        float part_depth_m = 0.0f;
        float full_depth_m = 0.0f;
    };
    /// First and last pixel of a row that are covered; none when first > last.
    struct Span {
        int first = 0, last = -1;
    };

    void cover(int column, int row, uint64_t bits, float depth_m);
    uint64_t outside_of(int column, int row) const;
    void fill(int first_row, int last_row, float depth_m);

    ViewMetric metric_;
    int width_px_ = 0, height_px_ = 0;
    int columns_ = 0, rows_ = 0;
    std::vector<Cell> cells_;  ///< [rows * columns], from the bottom left
    std::vector<Span> spans_;  ///< [height] scratch: of the solid that is being added
};

}  // namespace lod
