// relief_edit: relief that changes at run time: new heights for a rectangle of a grid, as plain data.
//
// An edit is a block of heights. Craters and excavations are ways to make one from the ground as it is; whatever
// else a host computes is a block as well. exchange() swaps a block with the grid, so what it leaves in the block
// undoes it. What else knows the ground takes the change over from the range alone: update() of HeightPyramid and
// HeightExtremes here, terrain::RoamFront::edit for what is drawn.
//
//     crater                            excavation
//       __                __           ____                    ____
//      /  \_            _/  \              \  slope           /
//     /     \__      __/     \              \________________/
//            radius_m  depth_m                 radius_m        depth_m below the ground at its middle
#pragma once

#include <vector>

#include "data/height_grid.h"

namespace data {

/// New heights for the samples of a range that lies in the grid; not for voids, which stay as they are.
struct HeightBlock {
    SampleRange range;
    std::vector<float> height_m;  ///< [range.rows() * range.columns()], row-major, finite
};

/// Swaps the block's heights with the grid's; doing it twice changes nothing. The grid's min_m and max_m only grow
/// wider: the lowest and highest of what was and what is. CHECKs that the block fits.
/// Cost: O(samples of the block).
void exchange(HeightGrid& grid, HeightBlock& block);

/// A bowl with a rim that falls off to the ground at twice the radius.
struct Crater {
    glm::dvec2 centre_grid{0.0};  ///< column, row; may lie outside the raster
    double radius_m = 100.0;      ///< to the crest of the rim, > 0
    double depth_m = 20.0;        ///< of the middle below the ground as it was, >= 0
    double rim_m = 4.0;           ///< height of the crest above the ground as it was, >= 0
};

/// A flat floor; around it slopes up to the ground. Nothing is heaped up.
struct Excavation {
    glm::dvec2 centre_grid{0.0};  ///< column, row; inside the raster
    double radius_m = 100.0;      ///< of the floor, > 0
    double depth_m = 20.0;        ///< of the floor below the ground at its middle, >= 0
    double slope_rad = 0.785;     ///< of the sides, in (0, pi / 2)
};

/// The block an edit makes of the ground as it is: as small as holds all that changes; empty where nothing does.
/// Distances are measured along the ground's cells at the centre.
/// Cost: O(samples within its reach); an excavation's slopes reach as far as the highest ground would need.
HeightBlock make_block(const HeightGrid& grid, const Crater& crater);
HeightBlock make_block(const HeightGrid& grid, const Excavation& excavation);

/// The block that gives a grid the heights of another one wherever that has ground: its sample's where they coincide,
/// between them its surface (ground_height.h). Empty where they do not meet.
/// Cost: O(samples that may lie in both), PROJ's 1 us each for projected rasters.
HeightBlock make_block(const HeightGrid& grid, const HeightGrid& other);

}  // namespace data
