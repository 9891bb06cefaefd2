// From a polygon mesh to a progressive model: every node's paint and glass become vertex hierarchies.
#pragma once

#include <string>
#include <string_view>

#include "data/polygon_mesh.h"
#include "lod/progressive/build_hierarchy.h"
#include "lod/progressive/progressive_model.h"

namespace sim {

/// Opacity below 0.5 is glass, emission above 0.5 glows, all else is paint (lod::Material), as in sim/model_parts.h.
/// @param threads  over parts; the result is the same for any number
/// Fails, naming the node, when a part's geometry cannot be used; parts without a triangle of an area are left out.
lod::Result<lod::ProgressiveModel> build_model(const data::PolygonMesh& mesh,
                                               const lod::BuildOptions& options, unsigned threads);

/// The largest factor by which a transform lengthens, or slightly more: errors of a node in the model.
double stretch_of(const glm::dmat4& transform);

/// Writes an .hpm file, whole or not at all.
lod::Result<lod::Ok> write_hpm(const std::string& path, const lod::ProgressiveModel& model);

/// Reads one. Fails with one line that names it.
lod::Result<lod::ProgressiveModel> read_hpm(const std::string& path);

}  // namespace sim
