// Schedule files: when objects appear, disappear and where they are, as CSV. They turn any model into a timed scene.
//
//     id,appears_s,disappears_s,time_s,x_m,y_m,z_m,qx,qy,qz,qw,model
//     ,,3600                                  the scene itself ends: T
//     slab-17,120.5,                          appears and stays
//     prop-3,120.5,300                        appears and disappears; a second row of prop-3 gives a second span
//     hook-1,,,0,10,20,30                     a key frame: upright at a place
//     hook-1,,,60,10,20,50,0,0,0.7071,0.7071  another; both rows speak of one object
//     crane,,,0,50,0,0,,,,,tower_crane.glb    a model of its own, path relative to the schedule
//
// The first line names the columns, in any order; `id` must be among them. Rows may come in any order; what nasty ones
// mean is settled in data/object_plan.h. Lines that are empty or begin with # are skipped; fields with a comma or quote
// are quoted, quotes doubled. Instead of the quaternion: heading_deg, clockwise from north, front towards -y.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "data/object_plan.h"
#include "data/timed_scene.h"
#include "lod/base/result.h"

namespace data {

/// What a schedule says of one object.
struct ScheduleEntry {
    std::vector<VisibilityStep> events;
    std::vector<KeyFrame> keys;  ///< none: the object stays where its source has it
    std::string model;           ///< path as written; empty: the object is in the scene's source
    int line = 0;                ///< of the file, where it is first named
};

struct Schedule {
    std::map<std::string, ScheduleEntry> entries;  ///< by id
    double end_s = 0.0;                            ///< 0: not said
};

/// Fails naming the line on an unknown or missing column, a field that is no finite number, a key frame that lacks a
/// coordinate or a part of its quaternion, and an end that is not after 0.
lod::Result<Schedule> read_schedule(const std::string& path);

/// T of a scene with this schedule: what it says, else the time of its last event or key frame after 0, else 1.
double end_of(const Schedule& schedule);

/// A scene's schedule as CSV: T, events, and the key frames that its GLB (data/timed_glb.h) does not hold to the last
/// bit. Numbers are the shortest that read back as themselves.
std::string schedule_csv(const TimedScene& scene);

}  // namespace data
