// ReliefTimeline: a scene's edits of the ground in the order of time, and how many of them are in force.
//
// The ground is a function of time: going on, edits are put in force one after the other; going back, they are taken
// back in reverse. What an edit needs that takes long, its heights and the colours of the ground, is made before the
// first frame; a frame swaps heights (data/relief_edit.h) and tells those who know the ground.
#pragma once

#include <span>
#include <vector>

#include "data/height_extremes.h"
#include "data/relief_edit.h"
#include "lod/base/result.h"
#include "render/mip_levels.h"
#include "sim/ground_texture.h"
#include "sim/scene_file.h"

namespace sim {

/// One edit.
struct TimedEdit {
    double time_s = 0.0;
    data::HeightBlock block;            ///< in force: the heights before it; else those it brings
    float low_m = 0.0f, high_m = 0.0f;  ///< of the heights it brings
    std::vector<render::TexelPatch> colours, colours_before;  ///< [level]; empty without a picture
};

struct ReliefTimeline {
    std::vector<TimedEdit> edits;      ///< by time; equal times as listed
    size_t in_force = 0;               ///< the first so many
    data::HeightExtremes extremes;     ///< of the ground as it is
    float min_m = 0.0f, max_m = 0.0f;  ///< of the ground without edits
};

/// What the ground was painted with.
struct GroundPaint {
    const data::Image& imagery;
    GroundTextureOptions options;
    data::Image& colours;  ///< the painted ground
};

/// Makes a scene's edits ready; afterwards none is in force, and ground and colours are as before.
/// @param paint  null without a picture
/// Fails, naming file and line, where an edit lies outside the terrain; with the reader's message on a raster.
lod::Result<ReliefTimeline> plan_relief(const Scene& scene, data::HeightGrid& ground,
                                        const GroundPaint* paint, unsigned threads);

/// Puts the texels of level 0 into the painted ground.
void put_texels(std::span<const render::TexelPatch> patches, data::Image& colours);

/// The edits in force at a time: those whose time has come.
size_t edits_at(const ReliefTimeline& timeline, double time_s);

/// Puts the next edit in force, or takes the last one back: the ground, its extremes and the timeline.
/// @returns what changed, for those who know the ground; valid until the timeline changes
const TimedEdit& step_relief(ReliefTimeline& timeline, data::HeightGrid& ground, bool forward);

}  // namespace sim
