// The plan of the construction site: where things stand and when they are built, shared by all its trades.
//
//            y                 tower   42 m square on 7 m bays, each storey 1.58 degrees further round
//      +-----------+           pit     84 m square around it, roofed over once the basement stands
//      |  pit      |           cranes  four masts at 34 m from the middle, one a side
//      |  +-----+  |           yards   beyond the pit's edges, within reach of the cranes
//      |  |tower|  | x         road    a ring at 92 m; the fleet stands beyond
//      +-----------+
#pragma once

#include <cstdint>
#include <numbers>

#include "data/scenes/scene_builder.h"

namespace data::site {

constexpr double kEndS = 3600.0;  // two years in an hour

constexpr int kStoreys = 57, kCellars = 2;  // above and below ground
constexpr double kStoreyM = 4.0;
constexpr double kTwistRad = std::numbers::pi / 2.0 / kStoreys;  // a quarter turn from ground to roof
constexpr double kBayM = 7.0;
constexpr int kHalfBays = 3;  // the tower is six bays wide
constexpr double kHalfTowerM = kBayM * kHalfBays;
constexpr double kHalfPitM = 42.0;
constexpr double kPitFloorM = -10.0;
constexpr double kMastM = 34.0;  // a crane's mast from the middle
constexpr double kRoadM = 92.0;  // the middle of the ring road from the middle

constexpr double kClearedS = 150.0;      // when the old quarter is gone
constexpr double kFirstStoreyS = 400.0;  // when the first storey is begun
constexpr double kStoreyS = 36.0;        // from one storey to the next
constexpr double kDismantleS = 2760.0;   // when the cranes come down

/// When storey `storey`, fractions allowed, is begun.
constexpr double storey_time(double storey) {
    return kFirstStoreyS + storey * kStoreyS;
}

/// The frame of a storey: its floor's middle, turned with the tower.
inline Placement storey_frame(double storey) {
    return {{0.0, 0.0, storey * kStoreyM}, storey * kTwistRad};
}

/// When the tower's highest floor is at a height above ground.
constexpr double time_of_height(double height_m) {
    return storey_time(height_m / kStoreyM);
}

/// The tower's highest floor at a time, m.
inline double tower_top_m(double time_s) {
    const double storeys = (time_s - kFirstStoreyS) / kStoreyS;
    return kStoreyM * (storeys < 0.0 ? 0.0 : storeys > kStoreys ? kStoreys : storeys);
}

constexpr Colour kConcrete{186, 181, 171}, kPaleConcrete{206, 202, 193}, kSteel{92, 100, 110},
    kPrimer{148, 74, 58}, kRust{132, 84, 56}, kPlywood{198, 156, 102}, kSafety{238, 132, 36},
    kYellow{236, 178, 36}, kWhite{228, 230, 231}, kAluminium{196, 202, 207}, kRubber{42, 43, 46},
    kSand{196, 176, 132}, kEarth{150, 124, 92}, kLeaf{88, 122, 62};

}  // namespace data::site
