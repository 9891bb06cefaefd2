#include "objects/reduction/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lod/base/check.h"

namespace objects {

namespace {

using lod::Triangle;

constexpr double kAimShare = 0.96;   ///< of the limit: as far as a pull goes
constexpr double kStepShare = 0.75;  ///< … between two samples of a triangle
constexpr int kMostSteps = 8;        ///< of a triangle's edge
constexpr int kRounds = 32;
constexpr uint32_t kNotAsked = 0xffffffffu;

/// What is still so far off after so many rounds is given up.
struct Hope {
    int rounds = 0;
    double most_share = 0.0;  ///< of the limit
};
constexpr std::array<Hope, 3> kHopes = {{{3, 1.8}, {6, 1.35}, {12, 1.12}}};

/// A point of a triangle that is asked how far from the surface it is, again only when it can have come too far.
struct Sample {
    glm::dvec3 shares{0.0};     ///< of the corners
    uint32_t near = kNotAsked;  ///< a face of the surface
    double safe_until_m = 0.0;  ///< of what its triangle has moved
};

struct Fitted {
    Triangle* triangle = nullptr;
    std::vector<Sample> samples;
    double moved_m = 0.0;  ///< no point of it has gone farther
};

/// A point of the surface, that is asked again only when its triangle can have left it.
struct Held {
    glm::dvec3 point{0.0};
    Fitted* nearest = nullptr;
    double safe_until_m = 0.0;

    bool is_safe() const { return nearest != nullptr && nearest->moved_m <= safe_until_m; }
};

/// Of the corners in a point of the triangle; they sum to one.
glm::dvec3 shares_at(const glm::dvec3& point, const Triangle& t) {
    const std::array<glm::dvec3, 3> corners = {t.a, t.b, t.c};
    const glm::dvec3 ab = t.b - t.a, ac = t.c - t.a, ap = point - t.a;
    const double bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac);
    const double area2 = bb * cc - bc * bc;
    if (area2 > 1e-9 * bb * cc) {
        const double pb = glm::dot(ap, ab), pc = glm::dot(ap, ac);
        const double b = (cc * pb - bc * pc) / area2, c = (bb * pc - bc * pb) / area2;
        const glm::dvec3 shares = glm::max(glm::dvec3(1.0 - b - c, b, c), glm::dvec3(0.0));
        return shares / (shares.x + shares.y + shares.z);
    }
    // Collapsed: by the longest edge.
    int from = 0;
    double longest2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double length2 = lod::squared_distance(corners[size_t(k)], corners[size_t((k + 1) % 3)]);
        if (length2 > longest2) longest2 = length2, from = k;
    }
    if (!(longest2 > 0.0)) return glm::dvec3(1.0 / 3.0);
    const int to = (from + 1) % 3;
    const glm::dvec3 start = corners[size_t(from)], along = corners[size_t(to)] - start;
    const double share = std::clamp(glm::dot(point - start, along) / longest2, 0.0, 1.0);
    glm::dvec3 shares(0.0);
    shares[from] = 1.0 - share;
    shares[to] = share;
    return shares;
}

glm::dvec3 point_at(const glm::dvec3& shares, const Triangle& t) {
    return shares.x * t.a + shares.y * t.b + shares.z * t.c;
}

/// Moves corners by their shares so that the point there moves by `by`.
void pull(const glm::dvec3& shares, const glm::dvec3& by, Fitted& fitted) {
    const glm::dvec3 move = shares / glm::dot(shares, shares);
    Triangle& t = *fitted.triangle;
    t.a += move.x * by;
    t.b += move.y * by;
    t.c += move.z * by;
    fitted.moved_m += std::max({move.x, move.y, move.z}) * glm::length(by);
}

/// Each point once, in the order of their first.
std::vector<Held> hold(std::span<const glm::dvec3> points) {
    std::vector<Held> held;
    for (const glm::dvec3& point : points) {
        const bool is_known =
            std::any_of(held.begin(), held.end(), [&](const Held& other) { return other.point == point; });
        if (!is_known) held.push_back({.point = point});
    }
    return held;
}

void take_samples(double limit_m, Fitted& fitted) {
    const Triangle& t = *fitted.triangle;
    const double longest2 = std::max(
        {lod::squared_distance(t.a, t.b), lod::squared_distance(t.b, t.c), lod::squared_distance(t.c, t.a)});
    const int steps =
        std::clamp(static_cast<int>(std::sqrt(longest2) / (kStepShare * limit_m)) + 1, 3, kMostSteps);
    for (int b = 0; b <= steps; ++b) {
        for (int c = 0; b + c <= steps; ++c)
            fitted.samples.push_back({.shares = glm::dvec3(steps - b - c, b, c) / double(steps)});
    }
}

/// The largest distance of a point from the triangles, before it has pulled; of those that are not safe.
double pull_to_points(std::span<Held> points, double limit_m, std::span<Fitted> all) {
    double worst_m = 0.0;
    for (Held& held : points) {
        if (held.is_safe()) continue;
        glm::dvec3 at(0.0);
        double distance2 = std::numeric_limits<double>::infinity();
        for (Fitted& fitted : all) {
            const glm::dvec3 here = lod::nearest_on_triangle(held.point, *fitted.triangle);
            const double here2 = lod::squared_distance(held.point, here);
            if (here2 < distance2) held.nearest = &fitted, at = here, distance2 = here2;
        }
        const double distance_m = std::sqrt(distance2), off_m = distance_m - kAimShare * limit_m;
        worst_m = std::max(worst_m, distance_m);
        held.safe_until_m = held.nearest->moved_m - off_m;
        if (off_m > 0.0)
            pull(shares_at(at, *held.nearest->triangle), off_m / distance_m * (held.point - at),
                 *held.nearest);
    }
    return worst_m;
}

/// … of a triangle's sample from the surface.
double pull_to_surface(const FitTarget& target, double limit_m, Fitted& fitted) {
    double worst_m = 0.0;
    uint32_t last_near = 0;
    for (Sample& sample : fitted.samples) {
        if (fitted.moved_m < sample.safe_until_m) continue;
        const glm::dvec3 point = point_at(sample.shares, *fitted.triangle);
        if (sample.near == kNotAsked) sample.near = last_near;
        glm::dvec3 at = lod::nearest_on_triangle(point, target.surface.triangle(sample.near));
        double distance_m = glm::length(at - point);
        if (distance_m > kAimShare * limit_m) {
            lod::TriangleHit hit = target.tree->any_within(point, kAimShare * limit_m);
            if (hit.distance_m > kAimShare * limit_m) hit = target.tree->nearest(point, distance_m);
            if (hit.distance_m < distance_m) sample.near = hit.triangle;
            at = lod::nearest_on_triangle(point, target.surface.triangle(sample.near));
            distance_m = glm::length(at - point);
        }
        last_near = sample.near;
        worst_m = std::max(worst_m, distance_m);
        sample.safe_until_m = fitted.moved_m + limit_m - distance_m;
        if (distance_m > kAimShare * limit_m)
            pull(sample.shares, (1.0 - kAimShare * limit_m / distance_m) * (at - point), fitted);
    }
    return worst_m;
}

}  // namespace

bool fit(const FitTarget& target, double limit_m, std::span<Triangle> triangles) {
    CHECK(!triangles.empty() && limit_m > 0.0);
    if (target.tree->is_empty()) return false;
    std::vector<Fitted> all(triangles.size());
    for (size_t i = 0; i < all.size(); ++i) {
        all[i].triangle = &triangles[i];
        take_samples(limit_m, all[i]);
    }
    std::vector<Held> points = hold(target.points);
    for (int round = 0; round < kRounds; ++round) {
        double worst_m = pull_to_points(points, limit_m, all);
        for (Fitted& fitted : all)
            worst_m = std::max(worst_m, pull_to_surface(target, limit_m, fitted));
        if (worst_m <= limit_m) return true;
        for (const Hope& hope : kHopes) {
            if (round >= hope.rounds && worst_m > hope.most_share * limit_m) return false;
        }
    }
    return false;
}

}  // namespace objects
