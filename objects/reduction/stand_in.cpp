#include "objects/reduction/stand_in.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lod/surface/surface_distance.h"
#include "objects/reduction/outline.h"
#include "objects/reduction/parts.h"
#include "objects/reduction/twisted_card.h"

namespace objects {

namespace {

constexpr size_t kMostFaces = 4096;  ///< of a part; what has more is hardly a prism
constexpr uint32_t kRings[] = {3, 4, 5, 6, 8, 12, 16};
constexpr double kSpikeCover =
    0.5 * std::numbers::pi;          ///< a sheet covers 2 / pi of its breadth, seen from all around
constexpr double kSlender = 4.0;     ///< so many breadths long
constexpr int kTurns = 24;           ///< of an axis towards the longest
constexpr double kUprightCos = 0.9;  ///< what is longest that way is seen from above only
constexpr double kReachShare = 0.9;  ///< of the limit, that something may be broader than what it stands for
constexpr double kFlatShare = 1.0 / 16.0;  ///< of its shorter side: as high, a part may be one side of a lid
constexpr double kPairShare = 0.8;         ///< of a part's radius, within which it may be a pair of faces
constexpr lod::PieceSearch kSearch{.most_pieces = 1024, .smallest_share = 1.0 / 16};

/// What may stand for a part, and the same surface in faces that are easier to prove.
struct Proposal {
    FaceSoup soup, pieces;
    bool is_card = false;
};

/// A part seen along an axis.
struct Seen {
    glm::dmat3 part_from_axes{1.0};  ///< third column: the axis
    double low_m = 0.0, high_m = 0.0;
    Outline outline, rectangle;
};

std::vector<glm::dvec3> used_points(const FaceSoup& part) {
    std::vector<uint8_t> is_used(part.points.size(), 0);
    std::vector<glm::dvec3> points;
    for (const auto& face : part.faces) {
        for (uint32_t corner : face) {
            if (is_used[corner] == 0) points.push_back(part.points[corner]);
            is_used[corner] = 1;
        }
    }
    return points;
}

Seen see_along(const std::vector<glm::dvec3>& points, const glm::dvec3& axis) {
    Seen seen;
    const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(other, axis));
    seen.part_from_axes = glm::dmat3(right, glm::cross(axis, right), axis);
    const glm::dmat3 axes_from_part = glm::transpose(seen.part_from_axes);
    std::vector<glm::dvec2> flat;
    flat.reserve(points.size());
    for (const glm::dvec3& point : points) {
        const glm::dvec3 at = axes_from_part * point;
        seen.low_m = flat.empty() ? at.z : std::min(seen.low_m, at.z);
        seen.high_m = flat.empty() ? at.z : std::max(seen.high_m, at.z);
        flat.emplace_back(at.x, at.y);
    }
    seen.outline = convex_outline(flat);
    seen.rectangle = least_rectangle(seen.outline);
    return seen;
}

/// Along the rectangle's longer side, through its middle.
struct Line {
    glm::dvec2 middle{0.0}, half{0.0};
};
Line long_line(const Outline& rectangle) {
    if (rectangle.size() < 4)
        return {0.5 * (rectangle.front() + rectangle.back()), 0.5 * (rectangle.back() - rectangle.front())};
    const glm::dvec2 one = 0.5 * (rectangle[1] - rectangle[0]), other = 0.5 * (rectangle[2] - rectangle[1]);
    return {0.5 * (rectangle[0] + rectangle[2]), glm::length(one) < glm::length(other) ? other : one};
}

double short_side_m(const Outline& rectangle) {
    if (rectangle.size() < 4) return 0.0;
    return std::min(glm::distance(rectangle[0], rectangle[1]), glm::distance(rectangle[1], rectangle[2]));
}

/// Appends what stands upright over a ring, then, if `has_caps`, what closes it.
void append_walls(const Seen& seen, const Outline& ring, bool has_caps, FaceSoup& out) {
    const uint32_t n = static_cast<uint32_t>(ring.size());
    for (const double z : {seen.low_m, seen.high_m}) {
        for (const glm::dvec2& corner : ring)
            out.points.push_back(seen.part_from_axes * glm::dvec3(corner.x, corner.y, z));
    }
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t next = (i + 1) % n;
        out.faces.push_back({i, next, n + next});
        out.faces.push_back({i, n + next, n + i});
    }
    for (uint32_t i = 1; has_caps && i + 1 < n; ++i) {
        out.faces.push_back({0, i + 1, i});
        out.faces.push_back({n, n + i, n + i + 1});
    }
}

/// The ring with a corner more wherever a corner of the outline is nearest: walls over it are no broader than those they
/// stand for, and each is near to one of them.
Outline cut_at(const Outline& ring, const Outline& outline) {
    Outline cut;
    std::vector<double> shares;
    for (size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 from = ring[i], along = ring[(i + 1) % ring.size()] - from;
        shares.assign(1, 0.0);
        for (const glm::dvec2& corner : outline) {
            const double share = glm::dot(corner - from, along) / glm::dot(along, along);
            const bool is_on_this_side =
                along.x * (corner.y - from.y) - along.y * (corner.x - from.x) < 0.5 * glm::dot(along, along);
            if (share > 0.0 && share < 1.0 && is_on_this_side) shares.push_back(share);
        }
        std::sort(shares.begin(), shares.end());
        for (const double share : shares)
            cut.push_back(from + share * along);
    }
    return cut;
}

Proposal prism_over(const Seen& seen, const Outline& ring) {
    Proposal prism;
    append_walls(seen, ring, true, prism.soup);
    append_walls(seen, cut_at(ring, seen.outline), false, prism.pieces);
    FaceSoup caps = prism.soup;
    caps.faces.erase(caps.faces.begin(), caps.faces.begin() + 2 * static_cast<std::ptrdiff_t>(ring.size()));
    append_soup(caps, glm::dmat3(1.0), glm::dvec3(0.0), prism.pieces);
    return prism;
}

/// What is flat along the axis, by one side of it half-way: a prism would show its two caps in one place, lit as they like.
Proposal lid_over(const Seen& seen, const Outline& ring) {
    FaceSoup lid;
    for (const glm::dvec2& corner : ring)
        lid.points.push_back(seen.part_from_axes *
                             glm::dvec3(corner.x, corner.y, 0.5 * (seen.low_m + seen.high_m)));
    for (uint32_t i = 1; i + 1 < ring.size(); ++i)
        lid.faces.push_back({0, i, i + 1});
    return {lid, lid};
}

/// How far what stands for a part leans: its foot one way, its head the other. Who looks along the axis sees as much of it as of
/// the part, as far as the limit allows.
/// @param room_m  what the limit leaves of it, upright
glm::dvec2 lean_of(const Seen& seen, const Line& line, double room_m) {
    const double half_m = glm::length(line.half), across_m = 0.5 * short_side_m(seen.rectangle);
    if (!(half_m > 0.0) || !(room_m > 0.0)) return glm::dvec2(0.0);
    return std::min(kReachShare * room_m, across_m) / half_m * glm::dvec2(-line.half.y, line.half.x);
}

Proposal sheet_over(const Seen& seen, const glm::dvec2& lean) {
    const Line line = long_line(seen.rectangle);
    FaceSoup sheet;
    for (const auto& [z, aside] : {std::pair(seen.low_m, -lean), std::pair(seen.high_m, lean)}) {
        for (const glm::dvec2& corner : {line.middle + aside - line.half, line.middle + aside + line.half})
            sheet.points.push_back(seen.part_from_axes * glm::dvec3(corner.x, corner.y, z));
    }
    sheet.faces = {{0, 1, 3}, {0, 3, 2}};
    return {sheet, sheet};
}

/// Foot below, tip above.
Proposal spike_over(const Seen& seen, const glm::dvec2& lean, double limit_m) {
    const Line line = long_line(seen.rectangle);
    const double half = glm::length(line.half);
    FaceSoup spike;
    const glm::dvec2 along = half > 0.0 ? line.half / half : glm::dvec2(1.0, 0.0);
    const glm::dvec2 foot = std::min(2.0 * kSpikeCover * half, half + kReachShare * limit_m) * along;
    const auto at = [&](const glm::dvec2& p, double z) {
        return seen.part_from_axes * glm::dvec3(p.x, p.y, z);
    };
    spike.points = {at(line.middle - lean - foot, seen.low_m), at(line.middle - lean + foot, seen.low_m),
                    at(line.middle + lean, seen.high_m)};
    spike.faces = {{0, 1, 2}};
    return {spike, spike};
}

/// For what is slender, of which a spike would show nothing from two sides. Half the outline's length covers as much.
Proposal card_over(const Seen& seen, double limit_m) {
    const Line line = long_line(seen.rectangle);
    double around_m = 0.0;
    for (size_t i = 0; i < seen.outline.size(); ++i)
        around_m += glm::distance(seen.outline[i], seen.outline[(i + 1) % seen.outline.size()]);
    Rod rod;
    rod.middle =
        seen.part_from_axes * glm::dvec3(line.middle.x, line.middle.y, 0.5 * (seen.low_m + seen.high_m));
    rod.axis = seen.part_from_axes[2];
    rod.length_m = seen.high_m - seen.low_m;
    rod.breadth_m = std::min(0.5 * around_m, 2.0 * (glm::length(line.half) + kReachShare * limit_m));
    FaceSoup card;
    append_card(twisted_card(rod), glm::u8vec4(0), card);
    return {card, card, true};
}

bool are_all_within(const FaceSoup& from, const lod::TriangleTree& to, double limit_m) {
    lod::PieceSearch search = kSearch;
    for (size_t face = 0; face < from.faces.size(); ++face) {
        if (!lod::is_within(from.view().triangle(face), to, limit_m, search)) return false;
    }
    return true;
}

/// Two faces that lean to either side: one with its foot below and a tip above, the other the other way round.
///
///     seen from above: the foot below | and its tip above +, the foot above / and its tip below o, as parts of the
///     radius. No point of the rim, above or below, is farther than 0.8 of it.
///
///                .-- ( -.2  .2 ) --.
///           o(-.6)      / |      +(.6)
Proposal pair_over(const Seen& seen) {
    constexpr double kFoot = 0.2, kTip = 0.6;
    const Line line = long_line(seen.rectangle);
    const glm::dvec2 across(-line.half.y, line.half.x);
    FaceSoup pair;
    for (const double side : {1.0, -1.0}) {
        const double foot_m = side > 0.0 ? seen.low_m : seen.high_m,
                     tip_m = seen.low_m + seen.high_m - foot_m;
        const glm::dvec2 foot = line.middle + side * kFoot * across, tip = line.middle + side * kTip * across;
        const uint32_t first = static_cast<uint32_t>(pair.points.size());
        for (const glm::dvec2& corner : {foot - line.half, foot + line.half})
            pair.points.push_back(seen.part_from_axes * glm::dvec3(corner.x, corner.y, foot_m));
        pair.points.push_back(seen.part_from_axes * glm::dvec3(tip.x, tip.y, tip_m));
        pair.faces.push_back({first, first + 1, first + 2});
    }
    return {pair, pair};
}

/// Along which points are spread most. Source: the power method.
glm::dvec3 long_axis(const std::vector<glm::dvec3>& points) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& point : points)
        middle += point / static_cast<double>(points.size());
    glm::dmat3 spread(0.0);
    for (const glm::dvec3& point : points)
        spread += glm::outerProduct(point - middle, point - middle);
    glm::dvec3 axis(spread[0][0] + 1e-12, spread[1][1] + 1e-12, spread[2][2] + 1e-12);
    for (int turn = 0; turn < kTurns; ++turn) {
        axis = spread * axis;
        const double size = glm::length(axis);
        if (!(size > 0.0)) return glm::dvec3(0, 0, 1);
        axis /= size;
    }
    return axis;
}

/// Proposals along one axis that look near enough, fewest faces first.
void propose_along(const Seen& seen, size_t faces, double limit_m, std::vector<Proposal>& out) {
    const Line line = long_line(seen.rectangle);
    const glm::dvec2 upright(0.0);
    double farthest = 0.0;
    for (const glm::dvec2& corner : seen.outline)
        farthest = std::max(farthest, glm::distance(corner, line.middle));
    const bool is_slender = seen.high_m - seen.low_m >= 2.0 * kSlender * glm::length(line.half);
    if (farthest <= limit_m && is_slender) out.push_back(card_over(seen, limit_m));
    if (farthest <= limit_m && !is_slender) {
        out.push_back(spike_over(seen, lean_of(seen, line, limit_m - farthest), limit_m));
        out.push_back(spike_over(seen, upright, limit_m));
    }
    if (kPairShare * farthest <= limit_m && farthest > limit_m) out.push_back(pair_over(seen));
    const double off_m = corner_distance(seen.outline, {line.middle - line.half, line.middle + line.half});
    if (off_m <= limit_m) {
        out.push_back(sheet_over(seen, lean_of(seen, line, limit_m - off_m)));
        out.push_back(sheet_over(seen, upright));
    }
    if (seen.outline.size() < 3) return;
    const double height_m = seen.high_m - seen.low_m;
    const bool is_flat = height_m <= 2.0 * limit_m && height_m <= kFlatShare * short_side_m(seen.rectangle);
    for (const uint32_t corners : kRings) {
        const auto propose_over = [&](const Outline& ring) {
            if (corner_distance(seen.outline, ring) > limit_m) return;
            if (is_flat) out.push_back(lid_over(seen, ring));
            if (4 * corners - 4 < faces) out.push_back(prism_over(seen, ring));
        };
        if (corners - 2 >= faces || (4 * corners - 4 >= faces && !is_flat)) return;
        if (corners == 4) propose_over(seen.rectangle);
        propose_over(balanced_ring(seen.outline, seen.rectangle, corners));
    }
}

bool is_of_one_kind(const FaceSoup& part) {
    return std::all_of(part.colours.begin(), part.colours.end(),
                       [&](const glm::u8vec4& colour) { return colour.w == part.colours[0].w; });
}

}  // namespace

StandIn stand_in(const FaceSoup& part, double limit_m) {
    if (part.faces.size() < 2 || part.faces.size() > kMostFaces || !is_of_one_kind(part)) return {};
    const std::vector<glm::dvec3> points = used_points(part);
    std::vector<Proposal> proposals;
    propose_along(see_along(points, glm::dvec3(0, 0, 1)), part.faces.size(), limit_m, proposals);
    const glm::dvec3 axis = long_axis(points);
    if (std::abs(axis.z) < kUprightCos)
        propose_along(see_along(points, axis), part.faces.size(), limit_m, proposals);
    std::stable_sort(proposals.begin(), proposals.end(), [](const Proposal& a, const Proposal& b) {
        return a.soup.faces.size() < b.soup.faces.size();
    });
    if (proposals.empty()) return {};
    const lod::TriangleTree tree(part.view());
    for (Proposal& proposal : proposals) {
        FaceSoup& found = proposal.soup;
        if (found.faces.size() >= part.faces.size()) break;
        if (!are_all_within(proposal.pieces, tree, limit_m) ||
            !are_all_within(part, lod::TriangleTree(found.view()), limit_m))
            continue;
        found.colours.assign(found.faces.size(), part.colours[0]);
        return {std::move(found), proposal.is_card};
    }
    return {};
}

StandIns stand_ins(const FaceSoup& source, double limit_m, double cell_m) {
    StandIns out;
    out.part_of_source.resize(source.faces.size());
    const WeldedSoup welded = weld(source, cell_m);
    for (const auto& faces : parts_of(source, welded.point_of, welded.soup.points.size())) {
        for (const uint32_t face : faces)
            out.part_of_source[face] = static_cast<uint32_t>(out.is_replaced.size());
        const FaceSoup part = part_of(source, faces);
        const StandIn found = stand_in(part, limit_m);
        const bool is_found = !found.soup.faces.empty();
        out.first_face.push_back(static_cast<uint32_t>(out.soup.faces.size()));
        out.is_replaced.push_back(is_found);
        const FaceSoup& least = is_found ? found.soup : part;
        append_soup(least, glm::dmat3(1.0), glm::dvec3(0.0), out.soup);
        append_soup(found.is_card ? part : least, glm::dmat3(1.0), glm::dvec3(0.0), out.to_grow);
    }
    out.first_face.push_back(static_cast<uint32_t>(out.soup.faces.size()));
    return out;
}

}  // namespace objects
