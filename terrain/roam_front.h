// The ROAM terrain behind lod::Front: split, forced split, merge and enhMerge on the bintree of one height grid.
#pragma once

#include <memory>

#include "data/height_grid.h"
#include "lod/front.h"

namespace terrain {

struct RoamOptions {
    double tolerance_px = 1.0;  ///< the tolerance the scheduler will ask for: queue buckets have an edge there
    unsigned threads = 2;       ///< for the error computation; the result does not depend on it
};

/// Computes the errors (about a second for 4097 x 4097 samples) and starts at the coarsest mesh.
/// @param grid  must outlive the front
std::unique_ptr<lod::Front> make_roam_front(const data::HeightGrid& grid, const RoamOptions& options);

}  // namespace terrain
