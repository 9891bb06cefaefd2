#include "sim/recorded_path.h"

#include <algorithm>

#include "data/ground_height.h"

namespace sim {

EyeState state_at(const RecordedPath& path, double time_s) {
    const data::MotionSample sample = data::motion_at(path.motion, time_s);
    EyeState state;
    state.site = sample.site;
    state.heading_rad = sample.heading_rad;
    state.pitch_rad = sample.pitch_rad;
    state.roll_rad = sample.roll_rad;

    const double begin_s = std::max(time_s - 0.5, 0.0),
                 end_s = std::min(time_s + 0.5, path.motion.duration_s());
    if (begin_s < end_s) {
        const data::SitePoint before = data::motion_at(path.motion, begin_s).site;
        const data::SitePoint after = data::motion_at(path.motion, end_s).site;
        const glm::dvec3 way_m = path.frame.world_from_site(after) - path.frame.world_from_site(before);
        state.speed_mps = glm::length(way_m) / (end_s - begin_s);
        state.vertical_speed_mps = (after.height_m - before.height_m) / (end_s - begin_s);
    }
    return state;
}

uint64_t lift_fixes(data::Motion& motion, const data::HeightGrid& ground, double clearance_m) {
    uint64_t lifted = 0;
    for (data::MotionSample& sample : motion.samples) {
        const data::GroundHeight below = data::ground_height(ground, sample.site);
        if (!below.valid || sample.site.height_m >= below.height_m + clearance_m) continue;
        sample.site.height_m = below.height_m + clearance_m;
        ++lifted;
    }
    return lifted;
}

}  // namespace sim
