#include "objects/reduction/breadth.h"

#include <algorithm>
#include <cmath>

#include "lod/surface/surface_distance.h"
#include "objects/reduction/twisted_card.h"

namespace objects {

namespace {

constexpr double kLeastBreadth = 0.25;  ///< of the limit; what is narrower is dotted when drawn whole, too
constexpr double kMostBreadth = 2.0;    ///< … what is broader is no rod; no card is broader than the limit
constexpr double kLeastLoad = 1.5;      ///< of its own area, that a face stands for
constexpr double kLeastLength = 2.0;    ///< breadths
constexpr double kWeldShare = 1e-3;     ///< of the limit: points that near are one when edges are compared
constexpr int kTurns = 12;              ///< of an axis towards the longest
constexpr lod::PieceSearch kSearch{.most_pieces = 4096, .smallest_share = 1.0 / 32};

/// [faces] whether some edge of it is no other's: such a face covers by itself, others share with what is behind them.
std::vector<uint8_t> has_border(const FaceSoup& soup, double limit_m) {
    const std::vector<uint32_t> point = weld(soup, kWeldShare * limit_m).point_of;
    struct Edge {
        uint32_t a, b, face;
    };
    std::vector<Edge> edges;
    for (uint32_t face = 0; face < soup.faces.size(); ++face) {
        for (uint32_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(point[soup.faces[face][k]], point[soup.faces[face][(k + 1) % 3]]);
            edges.push_back({a, b, face});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& p, const Edge& q) {
        return p.a != q.a ? p.a < q.a : (p.b != q.b ? p.b < q.b : p.face < q.face);
    });
    std::vector<uint8_t> is_open(soup.faces.size(), 0);
    const auto is_same = [&](size_t i, size_t k) {
        return edges[i].a == edges[k].a && edges[i].b == edges[k].b;
    };
    for (size_t i = 0; i < edges.size(); ++i) {
        if ((i == 0 || !is_same(i, i - 1)) && (i + 1 == edges.size() || !is_same(i, i + 1)))
            is_open[edges[i].face] = 1;
    }
    return is_open;
}

/// What of the source is nearest to a face: as a rod as long as its spread.
struct Load {
    double area_m2 = 0.0;                ///< of one sheet that covers as much
    glm::dvec3 moment{0.0};              ///< area times place
    glm::dmat3 second{glm::dmat3(0.0)};  ///< area times place times place

    void add(const glm::dvec3& point, double more_m2) {
        area_m2 += more_m2;
        moment += more_m2 * point;
        second += more_m2 * glm::outerProduct(point, point);
    }
};

std::vector<Load> loads_of(const FaceSoup& source, const NearestFaces& nearest, size_t count,
                           double limit_m) {
    const std::vector<uint8_t> is_open = has_border(source, limit_m);
    std::vector<Load> loads(count);
    for (size_t face = 0; face < source.faces.size(); ++face) {
        const lod::Triangle t = source.view().triangle(face);
        const double quarter_m2 = 0.25 * (is_open[face] != 0 ? 1.0 : 0.5) * lod::area_m2(t);
        const std::array<glm::dvec3, 4> points = quarters(t);
        for (size_t i = 0; i < points.size(); ++i) {
            if (nearest[face][i] != kNoFace) loads[nearest[face][i]].add(points[i], quarter_m2);
        }
    }
    return loads;
}

/// The rod whose points are spread along its axis like the load's.
Rod rod_of(const Load& load) {
    Rod rod;
    rod.middle = load.moment / load.area_m2;
    const glm::dmat3 spread = load.second / load.area_m2 - glm::outerProduct(rod.middle, rod.middle);
    glm::dvec3 axis(spread[0][0] + 1e-12, spread[1][1] + 1e-12, spread[2][2] + 1e-12);
    for (int turn = 0; turn < kTurns; ++turn) {
        axis = spread * axis;
        const double size = glm::length(axis);
        if (!(size > 0.0)) return rod;
        axis /= size;
    }
    rod.axis = axis;
    rod.length_m = std::sqrt(12.0 * std::max(glm::dot(axis, spread * axis), 0.0));
    rod.breadth_m = rod.length_m > 0.0 ? load.area_m2 / rod.length_m : 0.0;
    return rod;
}

bool is_thin(const Rod& rod, double limit_m) {
    return rod.breadth_m >= kLeastBreadth * limit_m && rod.breadth_m <= kMostBreadth * limit_m &&
           rod.length_m >= kLeastLength * rod.breadth_m;
}

void append_face(const FaceSoup& from, uint32_t face, FaceSoup& out) {
    out.faces.push_back(from.faces[face]);
    out.colours.push_back(from.colours[face]);
}

}  // namespace

void keep_breadth(const FaceSoup& source, const lod::TriangleTree& source_tree, const NearestFaces& nearest,
                  double limit_m, FaceSoup& result) {
    const std::vector<Load> loads = loads_of(source, nearest, result.faces.size(), limit_m);
    std::vector<uint8_t> is_replaced(result.faces.size(), 0);
    FaceSoup cards;
    for (uint32_t face = 0; face < result.faces.size(); ++face) {
        if (!(loads[face].area_m2 > kLeastLoad * lod::area_m2(result.view().triangle(face)))) continue;
        Rod rod = rod_of(loads[face]);
        if (!is_thin(rod, limit_m)) continue;
        rod.breadth_m = std::min(rod.breadth_m, limit_m);
        const std::array<glm::dvec3, 4> card = twisted_card(rod);
        lod::PieceSearch search = kSearch;
        if (!lod::is_within({card[0], card[1], card[2]}, source_tree, limit_m, search) ||
            !lod::is_within({card[1], card[2], card[3]}, source_tree, limit_m, search))
            continue;
        append_card(card, result.colours[face], cards);
        is_replaced[face] = 1;
    }
    if (cards.faces.empty()) return;
    FaceSoup broad;
    broad.points = result.points;
    for (uint32_t face = 0; face < result.faces.size(); ++face) {
        if (is_replaced[face] == 0) append_face(result, face, broad);
    }
    append_soup(cards, glm::dmat3(1.0), glm::dvec3(0.0), broad);
    // Where cards are not near everything that the faces were near, these stay as well.
    std::vector<uint32_t> lost;
    lod::find_beyond(source.view(), lod::TriangleTree(broad.view()), limit_m, lost, kSearch);
    for (uint32_t face = 0; face < result.faces.size() && !lost.empty(); ++face) {
        if (is_replaced[face] != 0) append_face(result, face, broad);
    }
    drop_unused_points(broad);
    result = std::move(broad);
}

}  // namespace objects
