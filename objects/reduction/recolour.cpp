#include "objects/reduction/recolour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "objects/reduction/finish.h"

namespace objects {

namespace {

constexpr double kLeastCosine = 0.5;     ///< 60 degrees: what faces elsewhere is seen from elsewhere
constexpr double kOffShare = 1e-5;       ///< of the limit: what lies so near is the face itself …
constexpr double kOnePlaneShare = 0.02;  ///< … or may show through it …
constexpr double kOutShare = 2.0;        ///< … and what is farther away is something else
constexpr double kTurnShare = 2.0;       ///< times as much seen of its back as of its front
constexpr double kLongFace = 2.0;        ///< limits: a longer face is asked at more points …
constexpr double kPointsPerArea = 8.0;  ///< … a limit long and a limit wide: what has little area says little
constexpr double kFewestPoints = 4.0, kMostPoints = 64.0;

glm::dvec3 light_of(const glm::u8vec4& colour) {
    const glm::dvec3 c(colour.x, colour.y, colour.z);
    return c * c;
}

/// Colours that meet on a face, by area.
struct Mixture {
    glm::dvec3 light{0.0};
    double weight = 0.0;

    void add(const glm::dvec3& more, double by) {
        light += by * more;
        weight += by;
    }
    void add(const Mixture& other) {
        light += other.light;
        weight += other.weight;
    }
};

/// Of one face of the result.
struct Mixtures {
    Mixture seen;         ///< by who looks at its front
    Mixture seen_behind;  ///< … at its back
    Mixture all;          ///< hidden or not, nearer to it than to other faces

    void add(const Mixtures& other) {
        seen.add(other.seen);
        seen_behind.add(other.seen_behind);
        all.add(other.all);
    }
};

/// A point of a source face, and the face of the result that is nearest.
struct Sample {
    glm::dvec3 point;
    uint32_t near = kNoFace;
};

/// The points that speak for a face, each for as much of its area: its quarters; of a face that is small beside the limit its
/// middle alone; more of one that is long, and in no rows, lest a wall get a wrong share of its bands of windows.
void samples_of(const lod::Triangle& t, const std::array<uint32_t, 4>& nearest, double limit_m,
                std::vector<Sample>& out) {
    out.clear();
    const std::array<glm::dvec3, 4> points = quarters(t);
    const double longest_m =
        std::max({glm::length(t.b - t.a), glm::length(t.c - t.b), glm::length(t.a - t.c)});
    if (!(longest_m > kLongFace * limit_m)) {
        const size_t count = longest_m > limit_m ? points.size() : 1;
        for (size_t i = 0; i < count; ++i)
            out.push_back({points[i], nearest[i]});
        return;
    }
    const double wanted = kPointsPerArea * lod::area_m2(t) / (limit_m * limit_m);
    const int count = static_cast<int>(std::clamp(wanted, kFewestPoints, kMostPoints));
    for (int i = 1; i <= count; ++i) {
        // Evenly over a square, of which what is beyond the diagonal is turned back; not from 0, which lies on it and may be
        // a neighbour's. Source: Roberts, The unreasonable effectiveness of quasirandom sequences (2018).
        double whole = 0.0, along = std::modf(0.5 + 0.7548776662466927 * i, &whole),
               up = std::modf(0.5 + 0.5698402909980532 * i, &whole);
        if (along + up > 1.0) along = 1.0 - along, up = 1.0 - up;
        const size_t quarter = along + up <= 0.5 ? 1 : along >= 0.5 ? 2 : up >= 0.5 ? 3 : 0;
        out.push_back({t.a + along * (t.b - t.a) + up * (t.c - t.a), nearest[quarter]});
    }
}

/// Two halves of one flat four-sided face get one colour: those whose longest edge is one and the same, the diagonal.
void join_halves(const FaceSoup& soup, std::vector<Mixtures>& mixtures) {
    constexpr double kFlatCosine = 0.999;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> by_diagonal;
    for (uint32_t face = 0; face < soup.faces.size(); ++face) {
        const auto& corners = soup.faces[face];
        std::pair<uint32_t, uint32_t> longest;
        double longest_m = 0.0;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = corners[k], b = corners[(k + 1) % 3];
            const double length_m = glm::length(soup.points[b] - soup.points[a]);
            if (length_m > longest_m) longest_m = length_m, longest = std::minmax(a, b);
        }
        const auto [half, is_first] = by_diagonal.emplace(longest, face);
        if (is_first || is_glass(soup.colours[face]) || is_glass(soup.colours[half->second])) continue;
        const glm::dvec3 one = lod::area_vector_m2(soup.view().triangle(face)),
                         other = lod::area_vector_m2(soup.view().triangle(half->second));
        if (!(glm::dot(one, other) > kFlatCosine * glm::length(one) * glm::length(other))) continue;
        mixtures[face].add(mixtures[half->second]);
        mixtures[half->second] = mixtures[face];
    }
}

/// Faces of which the back is what is seen are turned over: contraction pulls a wall from a floor's edge, and with it the
/// floor's idea of what is outside.
void turn_to_the_seen(FaceSoup& soup, std::vector<Mixtures>& mixtures) {
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        auto& [seen, seen_behind, all] = mixtures[face];
        if (!(seen_behind.weight > kTurnShare * seen.weight)) continue;
        std::swap(soup.faces[face][1], soup.faces[face][2]);
        std::swap(seen, seen_behind);
    }
}

bool are_all_alike(const std::vector<glm::u8vec4>& colours) {
    return std::adjacent_find(colours.begin(), colours.end(), std::not_equal_to<>()) == colours.end();
}

bool is_met(const lod::TriangleHit& hit) {
    return hit.triangle != kNoFace;
}

}  // namespace

void recolour(const FaceSoup& source, const lod::TriangleTree& source_tree, const NearestFaces& nearest,
              double limit_m, FaceSoup& result) {
    if (are_all_alike(source.colours) && are_all_alike(result.colours)) return;
    std::vector<Mixtures> mixtures(result.faces.size());
    const lod::TriangleTree result_tree(result.view());
    std::vector<Sample> samples;
    const auto add = [&](uint32_t face, const glm::dvec3& area, const glm::dvec3& light,
                         auto Mixtures::*towards, auto Mixtures::*away) {
        if (face == kNoFace || is_glass(result.colours[face])) return;
        const glm::dvec3 front = lod::area_vector_m2(result.view().triangle(face));
        const double cosine = glm::dot(area, front) / (glm::length(area) * glm::length(front));
        if (!(std::abs(cosine) >= kLeastCosine)) return;
        (mixtures[face].*(cosine > 0.0 ? towards : away)).add(light, glm::length(area) * std::abs(cosine));
    };
    for (size_t face = 0; face < source.faces.size(); ++face) {
        if (is_glass(source.colours[face])) continue;
        const lod::Triangle triangle = source.view().triangle(face);
        const glm::dvec3 whole = lod::area_vector_m2(triangle), light = light_of(source.colours[face]);
        const double size = glm::length(whole);
        if (!(size > 0.0)) continue;
        samples_of(triangle, nearest[face], limit_m, samples);
        const glm::dvec3 area = whole / static_cast<double>(samples.size()), out = (limit_m / size) * whole;
        for (const auto& [point, near] : samples) {
            add(near, area, light, &Mixtures::all, &Mixtures::all);
            if (source_tree.is_on_way(point + kOffShare * out, point + kOutShare * out)) continue;
            const lod::TriangleHit first = result_tree.first_on_way(point + out, point - out);
            add(first.triangle, area, light, &Mixtures::seen, &Mixtures::seen_behind);
            if (!is_met(first)) continue;
            // Where two lie in one plane either may be drawn.
            const glm::dvec3 at = point + (1.0 - first.distance_m / limit_m) * out;
            const lod::TriangleHit second =
                result_tree.first_on_way(at - kOffShare * out, at - kOnePlaneShare * out);
            if (second.triangle != first.triangle)
                add(second.triangle, area, light, &Mixtures::seen, &Mixtures::seen_behind);
        }
    }
    turn_to_the_seen(result, mixtures);
    join_halves(result, mixtures);
    for (size_t face = 0; face < result.faces.size(); ++face) {
        const auto& [seen, seen_behind, all] = mixtures[face];
        const Mixture& mixture = seen.weight > 0.0 ? seen : seen_behind.weight > 0.0 ? seen_behind : all;
        if (!(mixture.weight > 0.0)) continue;
        const glm::dvec3 mean = glm::sqrt(mixture.light / mixture.weight);
        const glm::u8vec3 mixed(glm::clamp(glm::round(mean), 0.0, 255.0));
        result.colours[face] = {mixed.x, mixed.y, mixed.z, result.colours[face].w};
    }
}

}  // namespace objects
