// Streets: their middle lines in site coordinates, with a width told from what kind they are.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "data/world_frame.h"
#include "lod/base/result.h"

namespace data {

/// One way for cars.
struct Street {
    std::vector<glm::dvec2> line;  ///< site x, y; at least two points
    double width_m = 0.0;          ///< > 0, pavements included where the source states a width
};

/// Reads the streets of anything OGR opens: lines with a `highway` that cars drive on, tunnels left out; width from
/// `width` (metres), else by the kind of street. Coordinates go to site coordinates of `world`, as in
/// data/footprints.h. A source without such lines gives none.
/// Fails on an unreadable or truncated file and on coordinates without CRS that are not degrees.
lod::Result<std::vector<Street>> read_streets(const std::string& path, const WorldFrame& world);

}  // namespace data
