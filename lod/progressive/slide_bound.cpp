#include "lod/progressive/slide_bound.h"

#include <algorithm>
#include <cmath>

#include "lod/surface/triangle.h"

namespace lod {
namespace {

/// A vertex on an outer edge is taken this share of its way inside, which costs as much.
constexpr double kInside = 1e-4;
/// A face that stands steeper tells little: its gaps are divided by this.
constexpr double kLeastFacing = 0.1;

/// Where an open star begins and ends; both null for a closed one.
struct Ends {
    const OuterEdge *first = nullptr, *last = nullptr;
};

/// Nothing when the outer edges are neither one ring nor one chain.
std::optional<Ends> ends_of(std::span<const OuterEdge> star) {
    Ends ends;
    for (const OuterEdge& edge : star) {
        int before = 0, behind = 0;
        for (const OuterEdge& other : star) {
            before += other.to == edge.from;
            behind += other.from == edge.to;
        }
        if (before > 1 || behind > 1) return {};
        const bool is_second =
            (before == 0 && ends.first != nullptr) || (behind == 0 && ends.last != nullptr);
        if (is_second) return {};
        if (before == 0) ends.first = &edge;
        if (behind == 0) ends.last = &edge;
    }
    return ends;
}

/// Of the triangle between a vertex and an outer edge; its length is twice the area.
glm::dvec3 across(const glm::dvec3& vertex, const OuterEdge& edge) {
    return glm::cross(edge.from_m - vertex, edge.to_m - vertex);
}

/// The mean of the faces' normals; nothing when a face has no area.
std::optional<glm::dvec3> axis_of(const glm::dvec3& vertex, std::span<const OuterEdge> star) {
    glm::dvec3 sum(0.0);
    for (const OuterEdge& edge : star) {
        const glm::dvec3 normal = across(vertex, edge);
        const double length = glm::length(normal);
        if (!(length > 0.0)) return {};
        sum += normal / length;
    }
    const double length = glm::length(sum);
    if (!(length > 0.0)) return {};
    return sum / length;
}

/// Whether the triangles, none of which is turned away from the axis, go round the vertex no more than once: only one of
/// them holds a ray.
bool goes_round_once(const glm::dvec3& vertex, std::span<const OuterEdge> star, const glm::dvec3& axis) {
    const glm::dvec3 ray = star.front().from_m - vertex;
    const auto holds_ray = [&](const OuterEdge& edge) {
        return glm::dot(glm::cross(edge.from_m - vertex, ray), axis) >= 0.0 &&
               glm::dot(glm::cross(ray, edge.to_m - vertex), axis) > 0.0;
    };
    return std::count_if(star.begin(), star.end(), holds_ray) == 1;
}

/// Of two stars over one polygon.
std::optional<double> gap_m(const glm::dvec3& place, const glm::dvec3& shown,
                            std::span<const OuterEdge> star) {
    const std::optional<glm::dvec3> axis = axis_of(place, star);
    if (!axis) return {};
    double gap = 0.0;
    for (const OuterEdge& edge : star) {
        const glm::dvec3 normal = glm::normalize(across(place, edge));
        const double facing = glm::dot(normal, *axis);
        if (facing < kLeastFacing || glm::dot(across(shown, edge), *axis) <= 0.0) return {};
        gap = std::max(gap, std::abs(glm::dot(shown - place, normal)) / facing);
    }
    if (!goes_round_once(place, star, *axis)) return {};
    return gap;
}

}  // namespace

std::optional<double> slide_bound_m(const glm::dvec3& place_m, const glm::dvec3& shown_m,
                                    std::span<const OuterEdge> star) {
    const std::optional<Ends> ends = ends_of(star);
    if (star.empty() || !ends) return {};
    glm::dvec3 place = place_m, shown = shown_m;
    double moved_m = 0.0;
    if (ends->first != nullptr) {
        const glm::dvec3 &from = ends->first->from_m, &to = ends->last->to_m;
        place = nearest_on_segment(place_m, from, to);
        shown = nearest_on_segment(shown_m, from, to);
        moved_m = glm::distance(place, place_m) + glm::distance(shown, shown_m);
        if (star.size() == 1) return moved_m;  // nothing is left of it
    }
    moved_m += kInside * glm::distance(place, shown);
    shown = glm::mix(shown, place, kInside);
    const std::optional<double> gap = gap_m(place, shown, star);
    if (!gap) return {};
    return *gap + moved_m;
}

}  // namespace lod
