// Star safety: may a triangle become another one when an edge collapses?
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace lod {

using Corner3 = std::array<glm::vec3, 3>;

struct SafetyLimits {
    double max_turn_cos = 0.5;
    double min_quality = 0.005;
};

/// Whether the normal turns by no more than the limit, never faces away from where the full mesh's triangle faces, and
/// the quality, 4 sqrt(3) area / (sum of squared sides), stays above its limit or does not fall.
/// @param full_normal  of the full mesh's triangle, any length; zero: it had no area
inline bool is_change_safe(const Corner3& before, const Corner3& after, const glm::vec3& full_normal,
                           const SafetyLimits& limits) {
    const auto normal_of = [](const Corner3& t) {
        return glm::cross(glm::dvec3(t[1]) - glm::dvec3(t[0]), glm::dvec3(t[2]) - glm::dvec3(t[0]));
    };
    const auto sides2_of = [](const Corner3& t) {
        const glm::dvec3 ab = glm::dvec3(t[1]) - glm::dvec3(t[0]), bc = glm::dvec3(t[2]) - glm::dvec3(t[1]),
                         ca = glm::dvec3(t[0]) - glm::dvec3(t[2]);
        return glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca);
    };
    constexpr double kSqrt12 = 3.4641016151377544;  // 4 sqrt(3) / 2: a cross product is twice an area
    const glm::dvec3 old_normal = normal_of(before), new_normal = normal_of(after);
    const double old2 = glm::dot(old_normal, old_normal), new2 = glm::dot(new_normal, new_normal);
    const double old_quality = old2 > 0.0 ? kSqrt12 * glm::sqrt(old2) / sides2_of(before) : 0.0;
    const double new_quality = new2 > 0.0 ? kSqrt12 * glm::sqrt(new2) / sides2_of(after) : 0.0;
    if (new_quality < limits.min_quality && new_quality < old_quality) return false;
    if (glm::dot(glm::dvec3(full_normal), new_normal) < 0.0) return false;
    if (!(old2 > 0.0)) return true;
    return glm::dot(old_normal, new_normal) >= limits.max_turn_cos * glm::sqrt(old2) * glm::sqrt(new2);
}

}  // namespace lod
