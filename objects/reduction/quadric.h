// Quadric: weighted mean square distance of a point to planes, kept as ten numbers.
//
// Source: Garland, Heckbert, Surface simplification using quadric error metrics (1997). Differs from it in: the sum is
// divided by the weights, so it is a square of metres and does not grow with the number of planes; the best point is
// drawn towards a given one, so that flat and straight surroundings have one as well.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace objects {

struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< sum of weight * n * transpose(n)
    glm::dvec3 linear{0.0};                                 ///< sum of weight * offset * n
    double constant = 0;                                    ///< sum of weight * offset^2
    double weight = 0;

    /// The plane dot(normal, point) + offset = 0. @param normal unit length
    void add_plane(const glm::dvec3& n, double offset, double w) {
        xx += w * n.x * n.x;
        xy += w * n.x * n.y;
        xz += w * n.x * n.z;
        yy += w * n.y * n.y;
        yz += w * n.y * n.z;
        zz += w * n.z * n.z;
        linear += (w * offset) * n;
        constant += w * offset * offset;
        weight += w;
    }

    void add(const Quadric& q) {
        xx += q.xx;
        xy += q.xy;
        xz += q.xz;
        yy += q.yy;
        yz += q.yz;
        zz += q.zz;
        linear += q.linear;
        constant += q.constant;
        weight += q.weight;
    }

    /// Mean square distance, m^2; never negative, 0 without planes.
    double mean_square(const glm::dvec3& p) const {
        if (!(weight > 0.0)) return 0.0;
        const glm::dvec3 product{xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z,
                                 xz * p.x + yz * p.y + zz * p.z};
        return std::max(0.0, (glm::dot(p, product) + 2.0 * glm::dot(linear, p) + constant) / weight);
    }

    /// Where the mean square is least, among points near `anchor` where it is flat.
    glm::dvec3 best_near(const glm::dvec3& anchor) const {
        const double pull = 1e-3 * weight + 1e-30;
        const glm::dmat3 matrix{{xx + pull, xy, xz}, {xy, yy + pull, yz}, {xz, yz, zz + pull}};
        return glm::inverse(matrix) * (pull * anchor - linear);
    }
};

}  // namespace objects
