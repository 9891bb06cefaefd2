// The guard band: a viewport several times as wide and high as the picture, which lies in its middle.
//
//     +--------------------------+   viewport: clip coordinates -1 … 1
//     |        +--------+        |
//     |        |picture |        |   the rasteriser leaves out pixels that are not there
//     |        +--------+        |
//     +--------------------------+
//
// A triangle that crosses the picture's edge lies inside the viewport and need not be cut. Mesa's software rasteriser sends
// a whole batch of triangles down a slower way when one of them has to be (docs/benchmarks.md); a GPU does the same thing in
// hardware and does not mind.
#pragma once

namespace render {

/// How many times as wide and high as the picture, which is that many pixels, > 0, the viewport is: 4, or less where the driver
/// has no room for that, 2 or 1. Powers of two, so that positions are rounded as without it. Needs a current context.
int guard_ratio(int width_px, int height_px);

/// For the next draws into a picture of that many pixels; state of the current context. @param ratio  as above
void set_viewport(int width_px, int height_px, int ratio);

}  // namespace render
