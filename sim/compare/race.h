// race: all methods fly the same sorties side by side, frame by frame, so that a disturbance meets all of them.
#pragma once

#include "render/renderer.h"
#include "sim/compare/calibrate.h"
#include "sim/compare/sorties.h"

namespace sim {

/// One method's times.
struct RaceTimes {
    std::vector<double> cpu_us;                ///< [frame of the flight] begin_frame, schedule and emit
    std::vector<double> frame_ms;              ///< [frame of the flight] the same and the picture, complete
    std::vector<double> turn_us, teleport_us;  ///< [half turn], [jump] begin_frame, schedule and emit
    std::vector<double> turn_operations;       ///< [half turn]
};

/// One entrant: a method and the tolerance at which its error is that of the others.
struct Entrant {
    Method* method;
    Calibration calibration;
};

/// Every front begins anew and converges in the first view before the clock runs. Who goes first changes from frame
/// to frame. Frames in which geometry had to be placed anew count for nobody. Turns and jumps are not drawn.
/// @param renderer  has the sorties' size; its pool is made as large as is needed
lod::Result<std::vector<RaceTimes>> race(std::vector<Entrant>& entrants, const Sorties& sorties,
                                         render::Renderer& renderer);

}  // namespace sim
