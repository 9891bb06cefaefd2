// How far two surfaces are apart, by dense samples that CGAL measures: shares nothing with the proof of
// lod/surface/surface_distance.h.
#pragma once

#include <CGAL/Simple_cartesian.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "objects/reduction/face_soup.h"

namespace objects_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

inline Kernel::Point_3 point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

/// Largest distance of samples of `from`, no farther than `spacing_m` from any of its points, to `to`. Faces without
/// area are no surface to CGAL.
inline double sampled_m(const objects::FaceSoup& from, const objects::FaceSoup& to, double spacing_m) {
    Triangles triangles;
    for (const auto& [a, b, c] : to.faces) {
        const Kernel::Triangle_3 t(point(to.points[a]), point(to.points[b]), point(to.points[c]));
        if (t.squared_area() > 1e-18) triangles.push_back(t);
    }
    Tree tree(triangles.begin(), triangles.end());
    tree.accelerate_distance_queries();
    double largest2 = 0.0;
    for (size_t face = 0; face < from.faces.size(); ++face) {
        const lod::Triangle t = from.view().triangle(face);
        const double longest =
            std::max({glm::length(t.b - t.a), glm::length(t.c - t.b), glm::length(t.a - t.c)});
        const int steps = 1 + static_cast<int>(longest / spacing_m);
        for (int i = 0; i <= steps; ++i) {
            for (int k = 0; i + k <= steps; ++k) {
                const glm::dvec3 at =
                    t.a + (double(i) / steps) * (t.b - t.a) + (double(k) / steps) * (t.c - t.a);
                largest2 = std::max(largest2, tree.squared_distance(point(at)));
            }
        }
    }
    return std::sqrt(largest2);
}

inline double sampled_both_ways_m(const objects::FaceSoup& a, const objects::FaceSoup& b, double spacing_m) {
    return std::max(sampled_m(a, b, spacing_m), sampled_m(b, a, spacing_m));
}

}  // namespace objects_test
