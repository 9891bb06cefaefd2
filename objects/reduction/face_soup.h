// FaceSoup: triangles with a colour each, the stuff that reduction works on. No topology, no normals.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lod/surface/triangle.h"

namespace objects {

struct FaceSoup {
    std::vector<glm::dvec3> points;              ///< metres, finite
    std::vector<std::array<uint32_t, 3>> faces;  ///< into points; collapsed and repeated ones are allowed
    std::vector<glm::u8vec4> colours;            ///< [faces] sRGB and the finish (finish.h)

    lod::Soup view() const { return {points, faces}; }
};

/// Appends a soup, moved: scene = rotation * point + offset.
void append_soup(const FaceSoup& soup, const glm::dmat3& rotation, const glm::dvec3& offset, FaceSoup& out);

/// A soup whose points of one grid cell have become one of them, without the faces that this collapses or repeats.
struct WeldedSoup {
    FaceSoup soup;
    std::vector<uint32_t> point_of;  ///< [points before] where each went
};

/// @param cell_m  > 0; no point moves farther than its diagonal
/// Cost: O(n) expected; the same for equal input.
WeldedSoup weld(const FaceSoup& soup, double cell_m);

/// Leaves out points that no face uses; keeps order.
void drop_unused_points(FaceSoup& soup);

}  // namespace objects
