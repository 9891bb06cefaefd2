// TriangleSieve: leaves out the triangles of a view that no pixel shows.
//
//     for each piece of geometry, near ones first:
//         for each of its triangles:   misses every pixel's centre, or stands behind what came before?  drop it
//                                      else keep it, and let it hide what comes after
//
// The picture of what is kept is that of everything, bit for bit. Worth its time where a triangle costs more than the
// 60 to 150 ns that asking takes: before a software rasteriser, not before a GPU. One sample a pixel is assumed.
//
// Several sieves can share the work, side by side in the picture: each judges the triangles whose middle lies in its
// columns by those it has kept itself.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lod/base/float4.h"
#include "lod/draw_list.h"
#include "lod/occlusion_map.h"

namespace lod {

/// A part of a picture as high as the picture. From left_px on, up to right_px.
struct Columns {
    float left_px = -std::numeric_limits<float>::infinity();
    float right_px = std::numeric_limits<float>::infinity();

    bool hold(float x_px) const { return x_px >= left_px && x_px < right_px; }
};

class TriangleSieve {
  public:
    /// Nothing hides anything yet. Cost: 16 bytes for each 64 pixels.
    /// @param own  what this sieve judges. Columns that share a picture meet, the outermost are unlimited
    void begin(const View& view, const Columns& own = {});

    /// Judges the triangles in its columns.
    /// @param vertices  that indices speak of  @param indices  of opaque triangles
    /// @param instance  as they will be drawn
    /// @param shows     a byte for each triangle: set to 1 where it may show
    /// Cost: 5 ns for each vertex between the first and the last of them, 20 to 150 ns a triangle.
    void sift(std::span<const Vertex> vertices, std::span<const uint32_t> indices, const Instance& instance,
              std::span<uint8_t> shows);

    /// Whether nothing of the hull of some points can show. @param corners_eye  eye frame, metres
    bool hides(std::span<const glm::dvec3> corners_eye) const { return map_.hides(corners_eye); }

  private:
    /// x and y in pixels from the lower left corner, depth in metres, negative from the near plane on.
    struct Corner {
        Float4 at;
    };

    void place(std::span<const Vertex> vertices, const Instance& instance);

    OcclusionMap map_;
    ViewMetric metric_;
    Columns own_;
    Float4 last_pixel_{};          ///< x and y
    std::vector<Corner> corners_;  ///< scratch: of what is being sifted
};

}  // namespace lod
