// FatFaces: flat convex faces of many corners, cut into triangles as fat as can be.
//
//        .-''-.             .-''-.
//      /'.  .'  \         / /____\ \        a fan's triangles are all long and thin, and a piece of the face lies on many of
//     |   '·.    |  ->   | /  \  /\ |       them; here the middle is one triangle, around it lie ever smaller ones, and most
//      \  .'  './         \ -- \/- /        pieces lie on one: what is near to a face is proved with few
//        '-..-'             '-..-'
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/reduction/face_soup.h"

namespace objects {

/// A convex ring of corners in triangles that turn the same way; none for fewer than three.
std::vector<std::array<uint32_t, 3>> fat_triangles(std::span<const uint32_t> ring);

/// The same surface, point by point: triangles of one colour that make up a flat convex face of five corners and more
/// without a point inside are cut anew. Points stay, and other faces, before the new ones.
/// Cost: O(n log n). Deterministic.
FaceSoup with_fat_faces(const FaceSoup& soup);

}  // namespace objects
