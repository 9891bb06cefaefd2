// Finish: how a face is lit, kept in the fourth number of its colour.
//
//      _____
//     |\    |\       one triangle for a tower has one normal, and would be as bright or as dark as a single wall of it;
//     | |   | | ->   /\   its light is the mean of what is seen from where the eye is: walls all round below a share of roof
//     |_|   |_|     /__\.
//
// Glass stays glass; what stands for surfaces that look one way is lit by its normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace objects {

/// FaceSoup::colours[].w; 1 … 254: opaque, for surfaces that look all round.
inline constexpr uint8_t kGlass = 0, kByNormal = 255;

/// @param up_share  of the surfaces that looks up, 0 … 1; walls all round are the rest
inline uint8_t all_round(double up_share) {
    return static_cast<uint8_t>(1 + std::lround(253.0 * std::clamp(up_share, 0.0, 1.0)));
}

inline bool is_glass(const glm::u8vec4& colour) {
    return colour.w == kGlass;
}
inline bool is_all_round(const glm::u8vec4& colour) {
    return colour.w != kGlass && colour.w != kByNormal;
}
/// Of what is all round.
inline double up_share(const glm::u8vec4& colour) {
    return (colour.w - 1) / 253.0;
}

/// Where surfaces look, summed over their areas.
struct Outlook {
    double area_m2 = 0.0;
    glm::dvec3 sum_m2{0.0};   ///< areas along the normals n …
    glm::dmat3 axes_m2{0.0};  ///< … times n * transpose(n): two sides of a plate count alike
    double up_m2 = 0.0;       ///< of the shadows on the ground of what looks up …
    double round_m2 = 0.0;    ///< … and of what is upright in the rest

    /// @param area_vector_m2  the area along the normal
    /// @param colour          of the face it is part of
    void add(const glm::dvec3& area_vector_m2, const glm::u8vec4& colour) {
        const double area = glm::length(area_vector_m2);
        if (!(area > 0.0)) return;
        if (is_all_round(colour)) {
            const double stands_for_m2 = 2.0 * area;
            area_m2 += stands_for_m2;
            up_m2 += up_share(colour) * stands_for_m2;
            round_m2 += (1.0 - up_share(colour)) * stands_for_m2;
            return;
        }
        area_m2 += area;
        sum_m2 += area_vector_m2;
        axes_m2 += glm::outerProduct(area_vector_m2, area_vector_m2 / area);
        up_m2 += std::max(area_vector_m2.z, 0.0);
        round_m2 += std::hypot(area_vector_m2.x, area_vector_m2.y);
    }
    void add(const Outlook& other) {
        area_m2 += other.area_m2;
        sum_m2 += other.sum_m2;
        axes_m2 += other.axes_m2;
        up_m2 += other.up_m2;
        round_m2 += other.round_m2;
    }

    /// Area of a face that covers as much, averaged over all directions: what has two sides shows one of them.
    /// Source: Cauchy's formula on projections (1841).
    double covering_m2() const { return 0.5 * (area_m2 + glm::length(sum_m2)); }

    /// Of an opaque face that stands for these surfaces.
    /// @param normal  of the face, any length
    uint8_t finish(const glm::dvec3& normal) const {
        constexpr double kOneWay = 0.9;   // half of a round tower's wall: 0.64, a third: 0.83
        constexpr double kOneAxis = 0.7;  // all of it: 0.5
        const double length2 = glm::dot(normal, normal);
        if (!(length2 > 0.0 && up_m2 + round_m2 > 0.0) || glm::length(sum_m2) >= kOneWay * area_m2 ||
            glm::dot(normal, axes_m2 * normal) >= kOneAxis * area_m2 * length2)
            return kByNormal;
        return all_round(up_m2 / (up_m2 + round_m2));
    }
};

}  // namespace objects
