// A PLY file's header, read before Assimp sees the file: it hangs on headers without end and trusts their counts.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace data {

/// What is wrong with the header, or with the length of what follows it; empty when nothing is.
/// @param content  the whole file; text needs a whole line for each element, binary data the bytes of its properties
std::optional<std::string> ply_problem(std::string_view content);

}  // namespace data
