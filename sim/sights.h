// Sights: the four places from which the demonstration takes its pictures, found in any scene.
#pragma once

#include <string>
#include <vector>

#include "sim/stage.h"

namespace sim {

struct Sight {
    std::string name;     ///< of the picture's file
    std::string caption;  ///< one line for the report
    Shot shot;
};

/// Ridge (a mountain side in the sun), town (if there are buildings), panel (if there are instruments) and horizon (from high
/// on the path, instruments in view). `middle_s` is the time of the last two.
std::vector<Sight> find_sights(const World& world, double middle_s);

}  // namespace sim
