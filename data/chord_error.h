// How far straight chords leave a mapped raster: the bound behind GroundFrame::chord_error_per_cell2.
#pragma once

#include "data/ecef_patches.h"
#include "data/ground_frame.h"

namespace data {

/// For a map f from the grid whose second derivative along every unit direction is at most M, a chord of n cells
/// leaves f by at most M n^2 / 8. M is measured from second differences of exact positions over the raster at
/// heights of -500 and 12,000 m (f is linear in height, so the ends bound what lies between), apart for the
/// local vertical and the plane across it, with a safety factor of 1.25.
///
/// The vertical turns along a chord: what is up at one place counts as sideways at another. Each part is
/// therefore widened by the other times the sine of the largest turn within the raster.
GroundFrame::ChordError chord_error_of(int width, int height, const ExactGround& exact);

}  // namespace data
