// Triangles as loose corners: where normals are made, and from where equal corners are welded to vertices.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace data {

/// Three corners a triangle, counter-clockwise outside; all arrays of the same length.
struct MeshCorners {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< unit length; zero: to be made
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec4> tints;     ///< sRGB and opacity, before textures
    std::vector<uint32_t> materials;  ///< the same for the three corners of a triangle
};

/// Numbers equal items equally, 0, 1, .. in order of first appearance.
/// @param words  [items * words_per_item]; items are equal when all their words are
/// Cost: O(n) expected.
std::vector<uint32_t> number_equal(std::span<const uint32_t> words, size_t words_per_item);

/// Gives every corner without a normal one: the mean, weighted by angle, of the facets that meet at its position and
/// lean less than 40 degrees from its own. Facets without area get their neighbours'; the last resort is +z.
void make_smooth_normals(MeshCorners& corners);

/// Equal corners as one vertex.
struct WeldedCorners {
    MeshCorners vertices;                            ///< one entry a vertex
    std::vector<std::array<uint32_t, 3>> triangles;  ///< in the order of the corners
};

/// Joins corners that agree in everything, bit for bit (-0 is 0).
WeldedCorners weld(const MeshCorners& corners);

}  // namespace data
