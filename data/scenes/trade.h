// Trade: one kind of work that comes back in every storey, and the order it is done in.
#pragma once

#include <string>
#include <vector>

#include "data/scenes/scene_builder.h"

namespace data::site {

/// Where a trade puts one object in a storey.
struct Spot {
    Placement in_storey;
    uint32_t mesh = 0;
    double order = 0.0;  ///< [0, 1): when, within the trade's time in a storey; see order_along_curve
};

/// Times are in storeys, counted from when the storey is begun: 8 is when the eighth above it is begun.
struct Trade {
    std::string kind;
    std::vector<Spot> spots;
    double begins = 0.0;  ///< the first object
    double takes = 1.0;   ///< until the last
    double stays = 0.0;   ///< each object; 0: for good
};

/// Orders spots along a Hilbert curve through the storey: erection proceeds from neighbour to neighbour.
void order_along_curve(std::vector<Spot>& spots);

/// Does a trade's work in one storey; times vary a little.
void add_trade(const Trade& trade, double storey, SceneBuilder& builder);

}  // namespace data::site
