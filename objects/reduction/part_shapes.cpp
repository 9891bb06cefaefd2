#include "objects/reduction/part_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "objects/reduction/fat_faces.h"
#include "objects/reduction/twisted_card.h"

namespace objects {

namespace {

constexpr double kSpikeCover =
    0.5 * std::numbers::pi;          ///< a sheet covers 2 / pi of its breadth, seen from all around
constexpr double kReachShare = 0.9;  ///< of the limit, that something may be broader than what it stands for
constexpr double kFlatShare = 1.0 / 16.0;  ///< of its shorter side: as high, a part may be one side of a lid
// Radii, in limits, up to and from which faces that lean together may do.
constexpr double kPairReach = 1.6, kFirstTent = 1.15, kTentReach = 2.2;

/// Appends what stands upright over a ring, then, if `has_caps`, what closes it.
void append_walls(const SeenPart& seen, const Outline& ring, bool has_caps, FaceSoup& out) {
    const uint32_t n = static_cast<uint32_t>(ring.size());
    for (const double z : {seen.low_m, seen.high_m}) {
        for (const glm::dvec2& corner : ring)
            out.points.push_back(seen.at(corner, z));
    }
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t next = (i + 1) % n;
        out.faces.push_back({i, next, n + next});
        out.faces.push_back({i, n + next, n + i});
    }
    if (!has_caps) return;
    std::vector<uint32_t> rim(n);
    std::iota(rim.begin(), rim.end(), 0u);
    for (const auto& [a, b, c] : fat_triangles(rim)) {
        out.faces.push_back({a, c, b});
        out.faces.push_back({n + a, n + b, n + c});
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

PartShape prism_over(const SeenPart& seen, const Outline& ring) {
    PartShape prism;
    append_walls(seen, ring, true, prism.soup);
    append_walls(seen, cut_at(ring, seen.outline), false, prism.pieces);
    FaceSoup caps = prism.soup;
    caps.faces.erase(caps.faces.begin(), caps.faces.begin() + 2 * static_cast<std::ptrdiff_t>(ring.size()));
    append_soup(caps, glm::dmat3(1.0), glm::dvec3(0.0), prism.pieces);
    return prism;
}

/// What is flat along the axis, by one side of it half-way: a prism would show its two caps in one place, lit as they like.
PartShape lid_over(const SeenPart& seen, const Outline& ring) {
    FaceSoup lid;
    for (const glm::dvec2& corner : ring)
        lid.points.push_back(seen.at(corner, 0.5 * (seen.low_m + seen.high_m)));
    std::vector<uint32_t> rim(ring.size());
    std::iota(rim.begin(), rim.end(), 0u);
    lid.faces = fat_triangles(rim);
    return {lid, lid};
}

/// How far what stands for a part leans: its foot one way, its head the other. Who looks along the axis sees as much of it as of
/// the part, as far as the limit allows.
/// @param room_m  what the limit leaves of it, upright
glm::dvec2 lean_of(const SeenPart& seen, const Line& line, double room_m) {
    const double half_m = glm::length(line.half), across_m = 0.5 * short_side_m(seen.rectangle);
    if (!(half_m > 0.0) || !(room_m > 0.0)) return glm::dvec2(0.0);
    return std::min(kReachShare * room_m, across_m) / half_m * glm::dvec2(-line.half.y, line.half.x);
}

PartShape sheet_over(const SeenPart& seen, const glm::dvec2& lean) {
    const Line line = long_line(seen.rectangle);
    FaceSoup sheet;
    for (const auto& [z, aside] : {std::pair(seen.low_m, -lean), std::pair(seen.high_m, lean)}) {
        for (const glm::dvec2& corner : {line.middle + aside - line.half, line.middle + aside + line.half})
            sheet.points.push_back(seen.at(corner, z));
    }
    sheet.faces = {{0, 1, 3}, {0, 3, 2}};
    return {sheet, sheet};
}

/// Foot below, tip above.
PartShape spike_over(const SeenPart& seen, const glm::dvec2& lean, double limit_m) {
    const Line line = long_line(seen.rectangle);
    const double half = glm::length(line.half);
    FaceSoup spike;
    const glm::dvec2 along = half > 0.0 ? line.half / half : glm::dvec2(1.0, 0.0);
    const glm::dvec2 foot = std::min(2.0 * kSpikeCover * half, half + kReachShare * limit_m) * along;
    spike.points = {seen.at(line.middle - lean - foot, seen.low_m),
                    seen.at(line.middle - lean + foot, seen.low_m), seen.at(line.middle + lean, seen.high_m)};
    spike.faces = {{0, 1, 2}};
    return {.soup = spike, .pieces = spike, .is_loose = true};
}

bool is_slender(const SeenPart& seen) {
    return seen.height_m() >= 2.0 * kSlender * glm::length(long_line(seen.rectangle).half);
}

/// For what is slender, of which a spike would show nothing from two sides. Half the outline's length covers as much.
PartShape card_over(const SeenPart& seen, double limit_m) {
    const Line line = long_line(seen.rectangle);
    double around_m = 0.0;
    for (size_t i = 0; i < seen.outline.size(); ++i)
        around_m += glm::distance(seen.outline[i], seen.outline[(i + 1) % seen.outline.size()]);
    Rod rod;
    rod.middle = seen.at(line.middle, 0.5 * (seen.low_m + seen.high_m));
    rod.axis = seen.part_from_axes[2];
    rod.length_m = seen.height_m();
    rod.breadth_m = std::min(0.5 * around_m, 2.0 * (glm::length(line.half) + kReachShare * limit_m));
    FaceSoup card;
    append_card(twisted_card(rod), glm::u8vec4(0), card);
    return {.soup = card, .pieces = card, .is_card = true};
}

/// Two faces that lean to either side: one with its foot below and a tip above, the other the other way round.
struct Pair {
    double foot_share = 0.0, tip_share = 0.0;  ///< of the radius, from the middle to one side
};

/// The first leans so far that it covers from above most of what it should, and is moved until it fits. Of the second no point of
/// the rim, above or below, is farther than 0.8 of the radius; seen from above, with its tips + and o:
///
///                .-- ( -.2  .2 ) --.
///           o(-.6)      / |      +(.6)
constexpr Pair kPairs[] = {{-0.4, 0.9}, {0.2, 0.6}};

PartShape pair_over(const SeenPart& seen, const Pair& shares) {
    const Line line = long_line(seen.rectangle);
    const glm::dvec2 across(-line.half.y, line.half.x);
    FaceSoup pair;
    for (const double side : {1.0, -1.0}) {
        const double foot_m = side > 0.0 ? seen.low_m : seen.high_m,
                     tip_m = seen.low_m + seen.high_m - foot_m;
        const glm::dvec2 foot = line.middle + side * shares.foot_share * across,
                         tip = line.middle + side * shares.tip_share * across;
        const uint32_t first = static_cast<uint32_t>(pair.points.size());
        for (const glm::dvec2& corner : {foot - line.half, foot + line.half})
            pair.points.push_back(seen.at(corner, foot_m));
        pair.points.push_back(seen.at(tip, tip_m));
        pair.faces.push_back({first, first + 1, first + 2});
    }
    return {.soup = pair, .pieces = pair, .is_loose = true};
}

/// Leaning walls around the middle below a roof: without it, a round tower would be off by half its radius just so, but hardly
/// be seen from above.
struct Tent {
    uint32_t walls = 0;
    bool is_alternating = false;               ///< every other wall has its head down: what is tall needs it
    double foot_share = 0.0, tip_share = 0.0;  ///< of the rectangle's halves
};

/// Three walls do for what is low, steep ones for what is broad.
constexpr Tent kTents[] = {{3, false, 1.0, 0.7}, {4, true, 1.0, 0.7}, {4, true, 0.8, 0.6}};

/// @param first_turn  of the first wall, in walls
PartShape tent_over(const SeenPart& seen, const Tent& tent, double first_turn) {
    const Line line = long_line(seen.rectangle);
    const double half_m = glm::length(line.half), across_m = 0.5 * short_side_m(seen.rectangle);
    const glm::dvec2 across =
        half_m > 0.0 ? across_m / half_m * glm::dvec2(-line.half.y, line.half.x) : glm::dvec2(0.0);
    const auto place = [&](double turn, double share) {
        const double angle = 2.0 * std::numbers::pi * turn;
        return line.middle + share * (std::cos(angle) * line.half + std::sin(angle) * across);
    };
    FaceSoup faces;
    const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const uint32_t first = static_cast<uint32_t>(faces.points.size());
        faces.points.insert(faces.points.end(), {a, b, c});
        faces.faces.push_back({first, first + 1, first + 2});
    };
    for (uint32_t i = 0; i < tent.walls; ++i) {
        const double turn = (i + first_turn) / tent.walls, side = 0.55 / tent.walls;
        const bool is_down = tent.is_alternating && i % 2 == 1;
        const double foot_m = is_down ? seen.high_m : seen.low_m, tip_m = is_down ? seen.low_m : seen.high_m;
        add(seen.at(place(turn - side, tent.foot_share), foot_m),
            seen.at(place(turn + side, tent.foot_share), foot_m),
            seen.at(place(turn, tent.tip_share), tip_m));
    }
    const Outline roof = balanced_ring(seen.outline, seen.rectangle, 3);
    add(seen.at(roof[0], seen.high_m), seen.at(roof[1], seen.high_m), seen.at(roof[2], seen.high_m));
    return {.soup = faces, .pieces = faces, .is_loose = true};
}

/// Sides of the rings that closed prisms have.
constexpr uint32_t kRings[] = {3, 4, 5, 6, 8, 12, 16};

void propose_prisms(const SeenPart& seen, size_t faces, double limit_m, std::vector<PartShape>& out) {
    if (seen.outline.size() < 3) return;
    const bool is_flat =
        seen.height_m() <= 2.0 * limit_m && seen.height_m() <= kFlatShare * short_side_m(seen.rectangle);
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

}  // namespace

void propose_shapes(const SeenPart& seen, size_t faces, double limit_m, std::vector<PartShape>& out) {
    const Line line = long_line(seen.rectangle);
    const glm::dvec2 upright(0.0);
    double farthest_m = 0.0;
    for (const glm::dvec2& corner : seen.outline)
        farthest_m = std::max(farthest_m, glm::distance(corner, line.middle));
    if (farthest_m <= limit_m) {
        const bool has_card = is_slender(seen);
        if (has_card) out.push_back(card_over(seen, limit_m));
        for (const glm::dvec2& lean : {lean_of(seen, line, limit_m - farthest_m), upright}) {
            out.push_back(spike_over(seen, lean, limit_m));
            out.back().is_for_gathering = has_card;
        }
    }
    if (farthest_m > limit_m && farthest_m <= kPairReach * limit_m) {
        for (const Pair& pair : kPairs)
            out.push_back(pair_over(seen, pair));
    }
    if (farthest_m > kFirstTent * limit_m && farthest_m <= kTentReach * limit_m) {
        for (const Tent& tent : kTents) {
            for (const double turn : {0.0, 0.5})
                out.push_back(tent_over(seen, tent, turn));
        }
    }
    const double off_m = corner_distance(seen.outline, {line.middle - line.half, line.middle + line.half});
    if (off_m <= limit_m) {
        out.push_back(sheet_over(seen, lean_of(seen, line, limit_m - off_m)));
        out.push_back(sheet_over(seen, upright));
    }
    propose_prisms(seen, faces, limit_m, out);
}

}  // namespace objects
