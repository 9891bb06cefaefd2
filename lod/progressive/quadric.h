// Quadric: a sum of squared distances to planes, and the point where it is least.
//
// Kept in a local frame (the mesh's middle at 0, its extent 1): in world coordinates the sum cancels to noise.
// Source: Garland, Heckbert, Surface simplification using quadric error metrics (1997).
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <optional>

namespace lod {

struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // matrix A
    double x = 0, y = 0, z = 0;                             // vector b
    double c = 0;
    double weight = 0;

    /// The plane dot(normal, p) = offset, weighted. @param normal  unit length
    static Quadric of_plane(const glm::dvec3& n, double offset, double weight) {
        return {weight * n.x * n.x,
                weight * n.x * n.y,
                weight * n.x * n.z,
                weight * n.y * n.y,
                weight * n.y * n.z,
                weight * n.z * n.z,
                -weight * n.x * offset,
                -weight * n.y * offset,
                -weight * n.z * offset,
                weight * offset * offset,
                weight};
    }

    Quadric& operator+=(const Quadric& o) {
        xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
        x += o.x, y += o.y, z += o.z, c += o.c, weight += o.weight;
        return *this;
    }

    /// The sum at a point; rounding may leave it slightly negative, then 0.
    double at(const glm::dvec3& p) const {
        const double ax = xx * p.x + xy * p.y + xz * p.z + 2.0 * x;
        const double ay = xy * p.x + yy * p.y + yz * p.z + 2.0 * y;
        const double az = xz * p.x + yz * p.y + zz * p.z + 2.0 * z;
        return std::max(0.0, p.x * ax + p.y * ay + p.z * az + c);
    }

    /// Where the sum is least; nothing where the planes do not fix a point: the determinant is too small beside
    /// what the trace allows.
    std::optional<glm::dvec3> least() const {
        constexpr double kLeastConditioning = 1e-4;  // of det / (trace / 3)^3, 1 for three square planes
        const double cx = yy * zz - yz * yz, cy = xz * yz - xy * zz, cz = xy * yz - xz * yy;
        const double det = xx * cx + xy * cy + xz * cz;
        const double mean = (xx + yy + zz) / 3.0;
        if (!(det > kLeastConditioning * mean * mean * mean)) return std::nullopt;
        const double dyy = xx * zz - xz * xz, dyz = xy * xz - xx * yz, dzz = xx * yy - xy * xy;
        return -glm::dvec3(cx * x + cy * y + cz * z, cy * x + dyy * y + dyz * z, cz * x + dyz * y + dzz * z) /
               det;
    }
};

}  // namespace lod
