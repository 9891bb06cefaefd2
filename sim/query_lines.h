// Questions about the ground as lines of text: two numbers ask for a height, six for a line of sight.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "data/world_frame.h"
#include "lod/base/result.h"

namespace sim {

/// One question.
struct QueryLine {
    data::SitePoint from, to;  ///< a height is asked at `from`, whose own height counts for nothing
    bool is_sight = false;     ///< the line of sight between both
    std::string where;         ///< file and line, for messages
};

/// Reads "x y" and "x y h x y h", longitude and latitude in degrees with a datum, heights in metres; spaces, tabs or
/// commas between. Empty lines and what follows a # are skipped.
/// @param name  of the stream, for messages
/// Fails naming the first line that is neither, or is no place in `frame`.
lod::Result<std::vector<QueryLine>> read_query_lines(std::istream& in, const std::string& name,
                                                     const data::WorldFrame& frame);

/// A question that was read elsewhere; fails when it is no place in `frame`.
lod::Result<lod::Ok> check_place(const data::WorldFrame& frame, const data::SitePoint& site,
                                 const std::string& where);

}  // namespace sim
