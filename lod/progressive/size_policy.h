// The size policy: what share of its triangles an instrument gets by the size of its picture, whatever the error.
//
// Source: Kalachev, Reshetnikova, step 6: the whole mesh above 300 px, then 80, 60, 40, 20 % in steps of 50 px, 10 %
// below 100 px. Harrier's own policy is the screen error; this one is for comparison.
#pragma once

namespace lod {

/// How a front decides how fine a body is drawn.
enum class DetailPolicy : unsigned char {
    kError,  ///< screen error against the tolerance
    kSize    ///< the paper's shares, worst nodes first
};

/// @param size_px  diameter of the body's sphere on the screen
inline double share_by_size(double size_px) {
    if (size_px > 300.0) return 1.0;
    if (size_px > 250.0) return 0.8;
    if (size_px > 200.0) return 0.6;
    if (size_px > 150.0) return 0.4;
    return size_px > 100.0 ? 0.2 : 0.1;
}

}  // namespace lod
