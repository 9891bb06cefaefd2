// Filling voids smoothly: averages on a pyramid, then a few sweeps that pull each sample towards its neighbours.
#pragma once

#include <cstdint>
#include <span>

namespace data {

/// Gives every void sample a height interpolated from valid ones around it: within their range, and close to
/// the surface a membrane spanned over the hole would have. Valid samples are left alone.
/// @param height_m  [height * width]; values of void samples are overwritten, not read
/// @param is_void   [height * width]; at least one sample must be valid, else nothing is done
/// Cost: O(width * height), memory 7 bytes per sample for a while.
void fill_voids(int width, int height, std::span<float> height_m, std::span<const uint8_t> is_void);

}  // namespace data
