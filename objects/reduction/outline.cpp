#include "objects/reduction/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace objects {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

double distance_to_segment(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + share * along);
}

double distance_to(const glm::dvec2& point, const Outline& outline) {
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < outline.size(); ++i)
        least = std::min(least, distance_to_segment(point, outline[i], outline[(i + 1) % outline.size()]));
    return least;
}

/// Appends one side of the hull of sorted points, the last of them left out.
template <typename Iterator>
void append_chain(Iterator begin, Iterator end, Outline& out) {
    const size_t first = out.size();
    for (; begin != end; ++begin) {
        while (out.size() >= first + 2 && cross(out.back() - out.end()[-2], *begin - out.back()) <= 0.0)
            out.pop_back();
        out.push_back(*begin);
    }
    out.pop_back();
}

}  // namespace

Outline convex_outline(std::span<const glm::dvec2> points) {
    Outline sorted(points.begin(), points.end());
    const auto key = [](const glm::dvec2& p) { return std::pair(p.x, p.y); };
    std::sort(sorted.begin(), sorted.end(), [&](const auto& p, const auto& q) { return key(p) < key(q); });
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 2) return sorted;
    Outline out;
    append_chain(sorted.begin(), sorted.end(), out);
    append_chain(sorted.rbegin(), sorted.rend(), out);
    return out;
}

Outline least_rectangle(const Outline& outline) {
    if (outline.size() < 3) return outline;
    Outline best;
    double best_area = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 along = glm::normalize(outline[(i + 1) % outline.size()] - outline[i]);
        const glm::dvec2 across(-along.y, along.x);
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const glm::dvec2& point : outline) {
            const glm::dvec2 at(glm::dot(point, along), glm::dot(point, across));
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        const double area = (high.x - low.x) * (high.y - low.y);
        if (!(area < best_area)) continue;
        best_area = area;
        const auto corner = [&](double x, double y) { return x * along + y * across; };
        best = {corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y), corner(low.x, high.y)};
    }
    return best;
}

Outline balanced_ring(const Outline& outline, const Outline& rectangle, uint32_t corners) {
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& corner : rectangle)
        middle += corner / static_cast<double>(rectangle.size());
    double farthest = 0.0;
    for (const glm::dvec2& corner : outline)
        farthest = std::max(farthest, glm::distance(middle, corner));
    const double mean = 0.5 * (farthest + distance_to(middle, outline));
    const double radius = 2.0 * mean / (1.0 + std::cos(std::numbers::pi / corners));
    const glm::dvec2 towards = outline[0] - middle;
    const double turn = std::atan2(towards.y, towards.x);
    Outline ring;
    for (uint32_t i = 0; i < corners; ++i) {
        const double angle = turn + 2.0 * std::numbers::pi * i / corners;
        ring.push_back(middle + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

double corner_distance(const Outline& a, const Outline& b) {
    double largest = 0.0;
    for (const glm::dvec2& corner : a)
        largest = std::max(largest, distance_to(corner, b));
    for (const glm::dvec2& corner : b)
        largest = std::max(largest, distance_to(corner, a));
    return largest;
}

}  // namespace objects
