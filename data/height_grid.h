// HeightGrid: the terrain's source data, one regular raster of heights with its place in the world.
//
// The truth every level of detail is measured against. Row-major from the north-west corner; row 0 is the
// northernmost whatever the file's order was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "data/ground_frame.h"
#include "lod/base/result.h"

namespace data {

/// Plain data. A void sample carries a finite, harmless height (interpolated from valid neighbours, inside the
/// valid range), so arithmetic on heights never meets NaN; `is_void` says that it is not a measurement.
struct HeightGrid {
    int width = 0, height = 0;     ///< samples; both >= 1
    std::vector<float> height_m;   ///< [height * width]
    std::vector<uint8_t> is_void;  ///< [height * width], 1: no measurement; empty when there is none at all
    /// [height * width], 1: was void and is filled, so it counts as measured; empty when there is none
    std::vector<uint8_t> is_filled;
    GroundFrame frame;
    float min_m = 0.0f, max_m = 0.0f;  ///< over valid samples; edits (relief_edit.h) may leave them wider

    size_t index(int col, int row) const {
        return static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(col);
    }
    float at(int col, int row) const { return height_m[index(col, row)]; }
    bool void_at(int col, int row) const { return !is_void.empty() && is_void[index(col, row)] != 0; }
    bool filled_at(int col, int row) const { return !is_filled.empty() && is_filled[index(col, row)] != 0; }
    bool has_voids() const { return !is_void.empty(); }
};

/// Inclusive bounds in samples; empty to begin with.
struct SampleRange {
    glm::ivec2 min{0}, max{-1};

    bool is_empty() const { return min.x > max.x || min.y > max.y; }
    /// 0 when empty, as are the rows.
    int columns() const { return is_empty() ? 0 : max.x - min.x + 1; }
    int rows() const { return is_empty() ? 0 : max.y - min.y + 1; }
    size_t count() const { return static_cast<size_t>(columns()) * static_cast<size_t>(rows()); }
};

/// What lies in both.
inline SampleRange common(const SampleRange& a, const SampleRange& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}
/// The samples of a grid.
inline SampleRange range_of(const HeightGrid& grid) {
    return {{0, 0}, {grid.width - 1, grid.height - 1}};
}

/// What becomes of voids.
enum class VoidPolicy : uint8_t {
    kHole,  ///< stay void: the mesh has a hole there
    kFill   ///< the interpolated height counts as measured
};

/// Options of read_height_grid.
struct HeightGridOptions {
    VoidPolicy voids = VoidPolicy::kFill;
    bool has_undeclared_nodata = true;  ///< treat the usual codes as void even where the file declares none
};

/// Reads one or several rasters of heights as one surface.
///
/// Anything GDAL opens; geographic or projected; pixel-is-area or -point; scale and offset; feet and other
/// units by the band's unit type; south-up and rotated 90 degrees. Void: the declared nodata value (also when
/// the file states it inexactly), NaN, infinities, and undeclared -32768, -32767, -9999, |x| > 12,000 m.
/// Several sources join on the grid of the first (its spacing, CRS and phase); where they overlap the first
/// listed wins; aligned tiles are copied exactly, others resampled bilinearly, voids never bleeding. Gaps
/// between tiles are void; a one-cell gap between pixel-is-area neighbours does not arise, they meet.
///
/// Fails with one line (file, place, expectation) on anything unreadable, truncated, smaller than 2 x 2 samples,
/// or without a valid sample.
lod::Result<HeightGrid> read_height_grid(const std::vector<std::string>& paths,
                                         const HeightGridOptions& options);

/// A grid without CRS, for tests, benchmarks and generated relief: spacing_m between samples, sample (0, 0) at
/// x = 0, y = (height - 1) * spacing_m, rows going south.
HeightGrid make_planar_grid(int width, int height, double spacing_m, std::vector<float> height_m);

}  // namespace data
