// Views for tests that think in the eye's frame.
#pragma once

#include "lod/view.h"

namespace lod_test {

/// From the origin along -z, near plane at half a metre.
inline lod::View view_of(int width_px, int height_px) {
    lod::View view;
    view.width_px = width_px;
    view.height_px = height_px;
    view.near_m = 0.5;
    return view;
}

}  // namespace lod_test
