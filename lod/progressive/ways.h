// FourWays: what displacements cost on the screen, four side by side.
#pragma once

#include <algorithm>
#include <span>

#include "lod/sight_metric.h"

namespace lod {

struct FourWays {
    FourBounds bounds;

    /// @param length_m  of the displacement of a point at `place`
    void set(int lane, const glm::vec3& place, float length_m) {
        bounds.set(lane, {place, length_m, length_m});
    }
    /// Pixels that the worst of them costs where it is in view, by the bound of lod/screen_error.h.
    double worst_px(std::span<const AnchoredEye> eyes) const {
        FourSights sight;
        for (const AnchoredEye& eye : eyes)
            sight.look(eye.lanes, bounds);
        const Float4 px = sight.shown_px;
        return double(std::max({px[0], px[1], px[2], px[3]}));
    }
};

}  // namespace lod
