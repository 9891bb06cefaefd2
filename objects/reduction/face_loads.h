// FaceLoads: which pieces of a surface each of a few faces is near to, so that each piece is near to one face as a whole.
#pragma once

#include <vector>

#include "objects/reduction/face_soup.h"
#include "objects/reduction/finish.h"

namespace objects {

/// What a face stands for, in the frame of the soups it came from, metres. The distance to a face is convex, so what is near at its corners is near.
struct FaceLoad {
    lod::Triangle face;
    glm::u8vec4 colour{0};
    std::vector<glm::dvec3> corners;  ///< of the pieces, each once
    Outlook outlook;                  ///< of the pieces
    uint32_t part = 0;                ///< that they belong to, by whoever asks
};

/// @param surface  pieces are its faces, halved where no single one of `faces` is near to all of one
/// @param faces    a few, with colours
/// @param limit_m  > 0
/// @returns        a load for each of `faces`, some perhaps without corners; none when a piece is not near after some
///                 halvings
/// Cost: O(surface * faces).
std::vector<FaceLoad> share_out(const FaceSoup& surface, const FaceSoup& faces, double limit_m);

}  // namespace objects
