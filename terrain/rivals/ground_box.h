// GroundBox: an oriented box around a patch of ground, and how many pixels a metre of error inside it can cost.
//
// The metric of lod/screen_error.h over a box instead of a sphere: blocks are flat and wide, a sphere around one
// would come much nearer to a low eye than the ground does.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <span>

#include "data/height_grid.h"
#include "lod/view.h"

namespace terrain {

/// Samples of a rectangle, both ends included.
struct GridPatch {
    int min_col = 0, min_row = 0, max_col = 0, max_row = 0;
};

/// World frame, metres.
struct GroundBox {
    glm::dvec3 centre{0.0};
    glm::dmat3 axes{1.0};  ///< columns, orthonormal; the last is the local vertical
    glm::dvec3 half_m{0.0};
    double radius_m = 0.0;
};

/// The box that contains every sample of the patch and every triangle with its corners on them.
GroundBox ground_box(const data::HeightGrid& grid, const GridPatch& patch);

/// What one or several eyes can make of an error inside a box.
struct Sight {
    double px_per_m = 0.0;  ///< of an error that vanishes beside depth_m; 0: no eye sees the box
    double depth_m = 1.0;   ///< least depth of a visible point, > 0

    bool is_visible() const { return px_per_m > 0.0; }

    /// Upper bound of the pixels by which a displacement of error_m moves a visible point of the box. The point
    /// may come nearer to the eye by as much and move towards the rim: hence the two last factors.
    double error_px(double error_m) const {
        const double share = std::min(error_m / depth_m, 0.5);
        return px_per_m * error_m * (1.0 + 1.5 * share) / ((1.0 - share) * (1.0 - share));
    }
};

/// Cost: about 10 ns for a box that is far out of view, 50 ns else.
Sight sight_of(const lod::ViewMetric& view, const GroundBox& box);

/// The worst over several eyes.
Sight sight_of(std::span<const lod::ViewMetric> views, const GroundBox& box);

}  // namespace terrain
