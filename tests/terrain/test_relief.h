// Relief and views for the terrain tests: seeded, and the same on every machine.
#pragma once

#include <cmath>

#include "data/fractal_grid.h"
#include "lod/base/rng.h"
#include "lod/view.h"

namespace terrain_test {

using data::fractal_grid;

/// A level view over a planar grid: position in metres, heading clockwise from +y.
inline lod::View level_view(const glm::dvec3& eye, double heading_rad, double pitch_rad) {
    lod::View view;
    view.eye_world = eye;
    view.eye_from_world = lod::eye_from_attitude(glm::dmat3(1.0), heading_rad, pitch_rad, 0.0);
    view.fov_y_rad = 60.0 * 3.14159265358979 / 180.0;
    view.width_px = 1280;
    view.height_px = 720;
    return view;
}

}  // namespace terrain_test
