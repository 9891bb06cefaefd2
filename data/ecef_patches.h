// EcefPatches: any smooth map from a raster to the Earth as small polynomials.
//
// The raster is covered by square blocks of samples. Over each block the point at height 0 is a cubic, and the
// unit vertical a quadratic, in block coordinates u, v of [-1, 1], written in Chebyshev polynomials: sampling at
// Chebyshev nodes gives the coefficients as plain sums, and what is cut off is what is lost.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/base/result.h"

namespace data {

/// A point at height 0 and the unit vertical there; ECEF, metres. A point at height h is base + h * up.
struct GroundPoint {
    glm::dvec3 base{0.0};
    glm::dvec3 up{0.0};
};

/// The exact map: positions (column, row) to ground points, of equal length; NaN where there is none.
using ExactGround = std::function<void(std::span<const glm::dvec2> grid, std::span<GroundPoint> out)>;

/// Immutable after fit.
class EcefPatches {
  public:
    EcefPatches() = default;

    /// Chooses the largest block of 2^k samples, k <= 8, whose measured error stays below 0.1 mm for heights of
    /// -500..9000 m, and fits all blocks. Stops at k = 0, which is exact, or at k = 2 for rasters of more than a
    /// million samples (24 bytes a sample): a datum's shift grid with kinks may then leave more than that.
    /// Fails when `exact` has no finite answer inside the raster.
    /// Cost: about 21 evaluations of `exact` per block.
    static lod::Result<EcefPatches> fit(int width, int height, const ExactGround& exact);

    /// Where sample (col, row) lies at a height; inside the raster. Never allocates.
    glm::dvec3 at(int col, int row, double height_m) const;

    int block_samples() const { return 1 << shift_; }
    double measured_error_m() const { return error_m_; }

  private:
    struct Patch {
        std::array<glm::dvec3, 10> base;
        std::array<glm::dvec3, 6> up;
    };
    static_assert(sizeof(Patch) == 384);

    glm::ivec2 block_origin(int block_col, int block_row) const;
    void cut_into_blocks(int shift);
    bool fit_block(glm::ivec2 block, const ExactGround& exact, Patch& out);
    lod::Result<lod::Ok> fit_every(int stride, const ExactGround& exact);
    size_t index_of(int block_col, int block_row) const {
        return static_cast<size_t>(block_row) * static_cast<size_t>(blocks_.x) +
               static_cast<size_t>(block_col);
    }

    int width_ = 0, height_ = 0;
    int shift_ = 0;                 // a block is 2^shift_ samples wide and high, or the raster if smaller
    glm::ivec2 blocks_{0};          // columns, rows of blocks
    glm::ivec2 last_origin_{0};     // the last blocks are moved back to end with the raster
    glm::dvec2 centre_cells_{0.0};  // from a block's first sample to its middle
    glm::dvec2 half_cells_{1.0};    // half a block's extent, at least half a cell
    glm::dvec2 per_half_cell_{1.0};
    double error_m_ = 0.0;
    std::vector<Patch> patches_;  // [blocks_.y * blocks_.x]
};

}  // namespace data
