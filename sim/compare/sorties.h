// Sorties: the views every method is measured on: a coherent flight, half turns, and jumps to other places.
#pragma once

#include <vector>

#include "data/height_grid.h"
#include "lod/view.h"

namespace sim {

inline constexpr double kRate_hz = 60.0;
inline constexpr double kSpeed_mps = 100.0;

/// What the pictures are taken with, and how many of each kind.
struct SortieOptions {
    int width_px = 1280, height_px = 720;
    int frames = 120;     ///< of the flight
    int incoherent = 16;  ///< half turns, and jumps
};

/// All at 60 degrees vertical field of view; the eye is clear of the ground.
struct Sorties {
    std::vector<lod::View> flight;     ///< 100 m/s at 60 Hz, turning by 3 degrees a second, level
    std::vector<lod::View> turns;      ///< from the flight's end, each the other way round
    std::vector<lod::View> teleports;  ///< seeded places, any heading
};

/// Plans them over a grid; the same for the same grid and options.
Sorties plan_sorties(const data::HeightGrid& grid, const SortieOptions& options);

/// The views at which errors are made equal: the flight's beginning, middle and end.
std::vector<lod::View> calibration_views(const Sorties& sorties);

}  // namespace sim
