#include "objects/reduction/face_loads.h"

#include <algorithm>
#include <array>
#include <limits>

namespace objects {

namespace {

using lod::Triangle;

constexpr int kMostHalvings = 12;

double farthest_corner2(const Triangle& piece, const Triangle& face) {
    return std::max({lod::squared_distance(piece.a, face), lod::squared_distance(piece.b, face),
                     lod::squared_distance(piece.c, face)});
}

bool share_out_piece(const Triangle& piece, const glm::u8vec4& colour, double limit_m, int halvings,
                     std::vector<FaceLoad>& loads) {
    FaceLoad* nearest = nullptr;
    double least2 = std::numeric_limits<double>::infinity();
    for (FaceLoad& load : loads) {
        const double farthest2 = farthest_corner2(piece, load.face);
        if (farthest2 < least2) nearest = &load, least2 = farthest2;
    }
    if (least2 <= limit_m * limit_m) {
        nearest->corners.insert(nearest->corners.end(), {piece.a, piece.b, piece.c});
        nearest->outlook.add(lod::area_vector_m2(piece), colour);
        return true;
    }
    if (halvings == 0) return false;
    const Triangle turned = lod::turn_longest_first(piece);
    const glm::dvec3 middle = 0.5 * (turned.a + turned.b);
    return share_out_piece({turned.a, middle, turned.c}, colour, limit_m, halvings - 1, loads) &&
           share_out_piece({middle, turned.b, turned.c}, colour, limit_m, halvings - 1, loads);
}

void keep_each_once(std::vector<glm::dvec3>& points) {
    const auto key = [](const glm::dvec3& p) { return std::array{p.x, p.y, p.z}; };
    std::sort(points.begin(), points.end(),
              [&](const glm::dvec3& a, const glm::dvec3& b) { return key(a) < key(b); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

}  // namespace

std::vector<FaceLoad> share_out(const FaceSoup& surface, const FaceSoup& faces, double limit_m) {
    std::vector<FaceLoad> loads(faces.faces.size());
    for (size_t i = 0; i < loads.size(); ++i) {
        loads[i].face = faces.view().triangle(i);
        loads[i].colour = faces.colours[i];
    }
    for (size_t i = 0; i < surface.faces.size(); ++i) {
        if (!share_out_piece(surface.view().triangle(i), surface.colours[i], limit_m, kMostHalvings, loads))
            return {};
    }
    for (FaceLoad& load : loads)
        keep_each_once(load.corners);
    return loads;
}

}  // namespace objects
