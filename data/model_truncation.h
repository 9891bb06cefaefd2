// Whether a model file is all there, by what its own format states, before a library trusts it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace data {

/// What is missing from the file; empty when nothing is known to be. Checked: GLB's length and chunks, binary STL's
/// facet count, text STL's end, PLY's element counts, AC3D's counts of children and the end of its last object. OBJ
/// does not state its length: cut within a line it shows by the line's missing end, cut between two lines it is a
/// smaller model, and valid. Assimp itself refuses JSON that does not close and glTF buffers that are too short.
/// @param content    the whole file
/// @param extension  lower case, without dot
std::optional<std::string> truncation_problem(std::string_view content, std::string_view extension);

}  // namespace data
