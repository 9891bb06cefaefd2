// How far a drawn mesh departs from its source on the screen: face and border samples against all triangles of the
// other, nearest point by the textbook, through a plain grid of boxes. Knows nothing of fronts.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lod/base/rng.h"
#include "lod/progressive/mesh_cut.h"
#include "lod/view.h"
#include "tests/lod/plain_hierarchy.h"

namespace lod_test {

using Soup = std::vector<std::array<glm::dvec3, 3>>;

inline Soup soup_of(const PlainMesh& mesh) {
    Soup soup;
    for (const auto& [a, b, c] : mesh.triangles)
        soup.push_back(
            {glm::dvec3(mesh.positions[a]), glm::dvec3(mesh.positions[b]), glm::dvec3(mesh.positions[c])});
    return soup;
}

/// @param displacement_m  (node) -> from its place to where it is shown
template <typename Displacement>
Soup drawn(const lod::MeshCut& cut, const Displacement& displacement_m) {
    Soup soup;
    for (uint32_t t = 0; t < cut.mesh().triangle_count(); ++t) {
        if (!cut.is_drawn(t)) continue;
        soup.emplace_back();
        for (size_t i = 0; i < 3; ++i) {
            const lod::NodeId node = cut.corners(t)[i];
            soup.back()[i] = glm::dvec3(cut.mesh().hierarchy.position[node] + displacement_m(node));
        }
    }
    return soup;
}

inline Soup drawn(const lod::MeshCut& cut) {
    return drawn(cut, [](lod::NodeId) { return glm::vec3(0.0f); });
}

/// Nearest point of a segment.
inline glm::dvec3 nearest_on(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const double way = glm::dot(b - a, b - a);
    return way == 0.0 ? a : a + (b - a) * std::clamp(glm::dot(p - a, b - a) / way, 0.0, 1.0);
}

/// Nearest point of a triangle: the foot of the perpendicular where it falls inside, else on an edge.
inline glm::dvec3 nearest_on(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double area = glm::dot(n, n);
    if (area > 0.0) {
        const glm::dvec3 foot = p - n * (glm::dot(p - t[0], n) / area);
        bool is_inside = true;
        for (size_t i = 0; i < 3; ++i)
            is_inside = is_inside && glm::dot(glm::cross(t[(i + 1) % 3] - t[i], foot - t[i]), n) >= 0.0;
        if (is_inside) return foot;
    }
    glm::dvec3 best = nearest_on(p, t[0], t[1]);
    for (const glm::dvec3& other : {nearest_on(p, t[1], t[2]), nearest_on(p, t[2], t[0])}) {
        if (glm::distance(p, other) < glm::distance(p, best)) best = other;
    }
    return best;
}

/// Triangles sorted into square cells over x and y; asked ring by ring.
class CellGrid {
  public:
    explicit CellGrid(const Soup& soup) : soup_(soup) {
        glm::dvec3 low = soup[0][0], high = low;
        for (const auto& t : soup) {
            low = glm::min(low, glm::min(t[0], glm::min(t[1], t[2])));
            high = glm::max(high, glm::max(t[0], glm::max(t[1], t[2])));
        }
        low_ = low;
        cell_ = std::max(std::max(high.x - low.x, high.y - low.y) / kSide, 1e-12);
        cells_.resize(size_t{kSide + 1} * (kSide + 1));
        for (uint32_t i = 0; i < soup.size(); ++i) {
            const auto& [a, b, c] = soup[i];
            for (int y = row(std::min({a.y, b.y, c.y})); y <= row(std::max({a.y, b.y, c.y})); ++y) {
                for (int x = column(std::min({a.x, b.x, c.x})); x <= column(std::max({a.x, b.x, c.x})); ++x)
                    cell(x, y).push_back(i);
            }
        }
    }

    double distance(const glm::dvec3& p) const {
        double best = std::numeric_limits<double>::infinity();
        const int px = column(p.x), py = row(p.y);
        for (int ring = 0; ring <= 2 * kSide && (ring - 1) * cell_ < best; ++ring) {
            for (int y = py - ring; y <= py + ring; ++y) {
                const bool is_end = std::abs(y - py) == ring;
                for (int x = px - ring; x <= px + ring; x += is_end || ring == 0 ? 1 : 2 * ring) {
                    if (x < 0 || y < 0 || x > kSide || y > kSide) continue;
                    for (uint32_t i : cell(x, y))
                        best = std::min(best, glm::distance(p, nearest_on(p, soup_[i])));
                }
            }
        }
        return best;
    }

  private:
    static constexpr int kSide = 128;
    int column(double x) const { return static_cast<int>(std::floor((x - low_.x) / cell_)); }
    int row(double y) const { return static_cast<int>(std::floor((y - low_.y) / cell_)); }
    std::vector<uint32_t>& cell(int x, int y) { return cells_[static_cast<size_t>(y * (kSide + 1) + x)]; }
    const std::vector<uint32_t>& cell(int x, int y) const {
        return cells_[static_cast<size_t>(y * (kSide + 1) + x)];
    }

    const Soup& soup_;
    glm::dvec3 low_{0.0};
    double cell_ = 1.0;
    std::vector<std::vector<uint32_t>> cells_;
};

/// Samples of every face, of every edge and corner: what a border does is seen, too.
inline std::vector<glm::dvec3> samples_of(const Soup& soup, lod::Rng& rng) {
    std::vector<glm::dvec3> samples;
    for (const auto& t : soup) {
        for (size_t i = 0; i < 3; ++i) {
            samples.push_back(t[i]);
            samples.push_back(t[i] + (t[(i + 1) % 3] - t[i]) * rng.unit());
        }
        for (int i = 0; i < 2; ++i) {
            double u = rng.unit(), v = rng.unit();
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            samples.push_back(t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v);
        }
    }
    return samples;
}

struct Departure {
    double full_to_drawn_px = 0.0, drawn_to_full_px = 0.0;
};

/// The distance of each sample in view, on the screen as if it stood across the line of sight in the middle of the
/// picture: what a pixel of error means at the least.
inline double farthest_px(const std::vector<glm::dvec3>& samples, const CellGrid& other,
                          const lod::ViewMetric& metric) {
    double worst = 0.0;
    for (const glm::dvec3& sample : samples) {
        const glm::dvec3 eye = metric.eye_from_world * (sample - metric.eye_world);
        const double depth = -eye.z;
        if (depth < metric.near_m || std::abs(eye.x) > depth * metric.tan_x ||
            std::abs(eye.y) > depth * metric.tan_y)
            continue;
        worst = std::max(worst, other.distance(sample) * metric.lambda_px / depth);
    }
    return worst;
}

inline Departure departure_px(const PlainMesh& full, const Soup& drawn, const lod::ViewMetric& metric,
                              lod::Rng& rng) {
    const Soup source = soup_of(full);
    return {farthest_px(samples_of(source, rng), CellGrid(drawn), metric),
            farthest_px(samples_of(drawn, rng), CellGrid(source), metric)};
}

}  // namespace lod_test
