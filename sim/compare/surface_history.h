// SurfaceHistory: what the drawn surface has become since the frame before: which triangles are new, how far it jumped.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "data/height_grid.h"
#include "lod/view.h"
#include "terrain/drawn/drawn_mesh.h"

namespace sim {

/// Two frames' triangles, told apart by what they are made of.
struct SurfaceChange {
    double changed_share = 0.0;  ///< triangles whose corners are three samples that were no triangle before
    double popping_px =
        0.0;  ///< the farthest the surface has jumped over a sample in view, then and now, with the eye still
};

class SurfaceHistory {
  public:
    /// @param grid  must outlive it
    explicit SurfaceHistory(const data::HeightGrid& grid);

    /// The next frame. The first one changes nothing.
    /// Cost: sorting the triangles, and the samples under those that changed.
    SurfaceChange add(const lod::View& view, std::vector<terrain::DrawnTriangle> triangles);

  private:
    using Keys = std::vector<std::pair<uint64_t, uint32_t>>;  ///< hash, triangle; sorted

    double move(const lod::View& view, const std::vector<terrain::DrawnTriangle>& triangles,
                const Keys& places);

    const data::HeightGrid& grid_;
    std::vector<float> above_m_;  ///< [sample] of the surface as last drawn; NaN: not drawn
    std::vector<terrain::DrawnTriangle> triangles_;
    Keys corners_, places_;  ///< of triangles_: by samples, and by positions
    lod::View view_;         ///< of the frame before
    bool is_first_ = true;
};

}  // namespace sim
