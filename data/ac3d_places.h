// AC3D objects' places (`loc`), as the file has them. Assimp adds them to the vertices, before the rotation, and
// keeps them from the objects below; whoever wants a node's own frame has to take them back.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

namespace data {

/// @param extension  lower case, without dot
inline bool is_ac3d(std::string_view extension) {
    return extension == "ac" || extension == "acc" || extension == "ac3d";
}

/// The `loc` of every object in the order of the file, which is parents before children; 0 without one.
std::vector<glm::dvec3> ac3d_places(std::string_view content);

}  // namespace data
