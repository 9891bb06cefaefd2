// Gathering: neighbouring faces become one face, as long as that is near enough to all that they stood for.
//
//       /\     /\    /\            __
//      /__\   /__\  /__\   ->   .-'  `-._         what is between them is empty, but no point of it is farther from them
//      tower  tower  shed      /_________`-.      than the limit
//
// First the two that make up the smallest box, again and again; then faces that stand for little are dissolved: each of what
// they stand for goes to some neighbour.
#pragma once

#include <span>
#include <vector>

#include "lod/surface/triangle_tree.h"
#include "objects/reduction/face_loads.h"

namespace objects {

struct Gathered {
    lod::Triangle face;
    glm::u8vec4 colour{0};        ///< the mean, in light, by area
    std::vector<uint32_t> loads;  ///< what it stands for, at least one
};

/// @param source       everything there is, in metres; loads are in its frame
/// @param source_tree  of it: faces may be near to any of it
/// @param limit_m      > 0
/// @param loads        with corners; each face is proved to be within `limit_m` of the source, and its load of it
/// @param threads      at least 1; the result is the same for any
/// @returns            faces of which the same is true, no more of them; every load is one's
/// Cost: some 0.2 ms a load where neighbours are half as far apart as the limit is, less elsewhere. Deterministic.
std::vector<Gathered> gather(const FaceSoup& source, const lod::TriangleTree& source_tree, double limit_m,
                             std::span<const FaceLoad> loads, unsigned threads = 1);

}  // namespace objects
