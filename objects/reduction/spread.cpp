#include "objects/reduction/spread.h"

#include <algorithm>
#include <cmath>

#include "lod/surface/surface_distance.h"

namespace objects {

namespace {

using lod::Triangle;

constexpr lod::PieceSearch kSearch{.most_pieces = 1024, .smallest_share = 1.0 / 32};
constexpr int kRounds = 8;
constexpr double kMostFactor = 1.5;   ///< of one round
constexpr double kLeastFactor = 1.1;  ///< … nearer than that to what is wanted it is good
constexpr double kThinShare = 0.05;   ///< of the limit: what is narrower is first made that broad

/// Scales a face across its longest edge about its middle.
Triangle scaled_across(const Triangle& face, double factor, double least_m) {
    const Triangle turned = lod::turn_longest_first(face);
    const glm::dvec3 along = turned.b - turned.a, middle = (face.a + face.b + face.c) / 3.0;
    const double length = glm::length(along);
    if (!(length > 0.0)) return face;
    const glm::dvec3 axis = along / length;
    Triangle from = face;
    glm::dvec3 off = turned.c - turned.a;
    off -= glm::dot(off, axis) * axis;
    if (glm::length(off) < least_m) {
        const glm::dvec3 least = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        const glm::dvec3 across = glm::normalize(glm::cross(axis, least));
        from = {turned.a, turned.b, 0.5 * (turned.a + turned.b) + least_m * across};
    }
    const auto moved = [&](const glm::dvec3& corner) {
        const glm::dvec3 out = corner - middle, lengthwise = glm::dot(out, axis) * axis;
        return middle + lengthwise + factor * (out - lengthwise);
    };
    return {moved(from.a), moved(from.b), moved(from.c)};
}

}  // namespace

void spread(const FitTarget& target, std::span<const glm::dvec3> held, double limit_m, double wanted_m2,
            Triangle& face) {
    const auto is_near = [&](const Triangle& tried) {
        lod::PieceSearch search = kSearch;
        return std::all_of(held.begin(), held.end(),
                           [&](const glm::dvec3& point) {
                               return lod::squared_distance(point, tried) <= limit_m * limit_m;
                           }) &&
               lod::is_within(tried, *target.tree, limit_m, search);
    };
    double most = kMostFactor;
    for (int round = 0; round < kRounds && most >= kLeastFactor; ++round) {
        const double now_m2 = lod::area_m2(face), factor = now_m2 > 0.0 ? wanted_m2 / now_m2 : most;
        if (factor < kLeastFactor && factor > 1.0 / kLeastFactor) return;
        Triangle tried = scaled_across(face, std::clamp(factor, 1.0 / most, most), kThinShare * limit_m);
        const bool is_better = fit(target, limit_m, {&tried, 1}) &&
                               std::abs(lod::area_m2(tried) - wanted_m2) < std::abs(now_m2 - wanted_m2) &&
                               is_near(tried);
        if (is_better)
            face = tried;
        else
            most = std::sqrt(most);
    }
}

}  // namespace objects
