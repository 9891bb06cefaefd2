// Parts: the connected pieces of a soup.
#pragma once

#include <span>

#include "objects/reduction/face_soup.h"

namespace objects {

/// Faces of each part, ascending; parts in the order of their first faces. Faces are connected over points, near ones
/// over what they were welded to.
/// @param point_of     [points of the soup] what each became (WeldedSoup::point_of)
/// @param point_count  how many there are then
/// Cost: O(n).
std::vector<std::vector<uint32_t>> parts_of(const FaceSoup& soup, const std::vector<uint32_t>& point_of,
                                            size_t point_count);

/// Whether every edge of these faces is passed once each way: what they enclose has an inside.
/// @param point_of  as above
/// Cost: O(n log n).
bool is_closed(const FaceSoup& soup, std::span<const uint32_t> faces, const std::vector<uint32_t>& point_of);

/// Some faces of a soup as a soup of their own, without the points they do not use.
FaceSoup part_of(const FaceSoup& soup, const std::vector<uint32_t>& faces);

}  // namespace objects
