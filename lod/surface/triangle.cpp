#include "lod/surface/triangle.h"

#include <algorithm>

namespace lod {

namespace {

glm::dvec3 nearest_on_edges(const glm::dvec3& point, const Triangle& t) {
    glm::dvec3 nearest = nearest_on_segment(point, t.a, t.b);
    for (const glm::dvec3& other :
         {nearest_on_segment(point, t.b, t.c), nearest_on_segment(point, t.c, t.a)}) {
        if (squared_distance(point, other) < squared_distance(point, nearest)) nearest = other;
    }
    return nearest;
}

}  // namespace

glm::dvec3 nearest_on_triangle(const glm::dvec3& point, const Triangle& t) {
    const glm::dvec3 ab = t.b - t.a, ac = t.c - t.a;
    const glm::dvec3 ap = point - t.a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return t.a;
    const glm::dvec3 bp = point - t.b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return t.b;
    const glm::dvec3 cp = point - t.c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return t.c;
    // Twice the areas that the projected point makes with the edges, each times the area's length.
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const double sum = va + vb + vc;
    const double longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), squared_distance(t.b, t.c)});
    // Inside by a clear margin; slivers and everything near an edge go by the edges, where nothing cancels.
    if (va > 0.0 && vb > 0.0 && vc > 0.0 && sum > 1e-14 * longest2 * longest2)
        return t.a + (vb / sum) * ab + (vc / sum) * ac;
    return nearest_on_edges(point, t);
}

}  // namespace lod
