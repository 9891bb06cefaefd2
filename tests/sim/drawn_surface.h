// Judges a mesh that is to be a part of a terrain's surface, by geometry alone: where its vertices lie on the raster,
// which lie within other triangles' edges, how often edges are used, and whether it ends within the picture.
#pragma once

#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tests/sim/ply_reader.h"
#include "tests/terrain/dem_truth.h"
#include "tests/terrain/picture_point.h"

namespace sim_test {

/// What is wrong; all zero for a surface without cracks.
struct SurfaceFaults {
    size_t off_samples = 0;      ///< vertices that are not a sample of the raster, by place or height
    size_t twins = 0;            ///< vertices where another one is, in plan
    size_t within_edges = 0;     ///< T-junctions: vertices strictly inside an edge, in plan
    size_t overused_edges = 0;   ///< by more than one triangle on the same side
    size_t facing_down = 0;      ///< triangles clockwise from above
    size_t open_in_picture = 0;  ///< edges with a triangle on one side only, that the picture shows

    bool operator==(const SurfaceFaults&) const = default;
};

class DrawnSurface {
  public:
    /// @param mesh  ECEF  @param dem  in degrees
    DrawnSurface(const TriangleMesh& mesh, const terrain_test::DemTruth& dem) : mesh_(mesh), dem_(dem) {
        for (const glm::dvec3& vertex : mesh.vertices)
            plan_.push_back(plan_of(vertex));
        for (uint32_t i = 0; i < plan_.size(); ++i)
            vertices_at_[nearest(plan_[i])].push_back(i);
    }

    /// @param view  what the mesh was drawn for
    SurfaceFaults judge(const lod::View& view) const {
        SurfaceFaults faults;
        for (uint32_t i = 0; i < plan_.size(); ++i) {
            faults.off_samples += !is_sample(i);
            faults.twins += vertices_at_.at(nearest(plan_[i])).size() > 1;
        }
        std::map<Edge, int> uses;
        for (const Face& face : mesh_.faces) {
            faults.facing_down += !is_facing_up(face);
            for (size_t corner = 0; corner < 3; ++corner)
                ++uses[{face[corner], face[(corner + 1) % 3]}];
        }
        for (const auto& [edge, count] : uses) {
            faults.overused_edges += count > 1;
            const bool is_open = uses.count({edge.second, edge.first}) == 0;
            if (is_open || edge.first < edge.second) faults.within_edges += vertices_within(edge);
            faults.open_in_picture += is_open && !is_on_rim(edge) && is_seen(edge, view);
        }
        return faults;
    }

    /// Column and row, fractional; integers are samples.
    const glm::dvec2& plan(uint32_t vertex) const { return plan_[vertex]; }

  private:
    using Edge = std::pair<uint32_t, uint32_t>;
    using Cell = std::pair<int, int>;
    struct CellHash {
        size_t operator()(const Cell& cell) const {
            return static_cast<size_t>(cell.first) * 1'000'003u + static_cast<size_t>(cell.second);
        }
    };
    static constexpr double kSamePlace = 1e-4;  // cells; 9 mm
    static constexpr double kSameHeight_m = 1e-3;

    glm::dvec2 plan_of(const glm::dvec3& world) const {
        double lat = 0.0, lon = 0.0, height = 0.0;
        GeographicLib::Geocentric::WGS84().Reverse(world.x, world.y, world.z, lat, lon, height);
        return {(lon - dem_.geo[0]) / dem_.geo[1] - 0.5, (lat - dem_.geo[3]) / dem_.geo[5] - 0.5};
    }
    static Cell nearest(const glm::dvec2& plan) {
        return {static_cast<int>(std::lround(plan.x)), static_cast<int>(std::lround(plan.y))};
    }

    bool is_sample(uint32_t vertex) const {
        const auto [col, row] = nearest(plan_[vertex]);
        if (glm::distance(plan_[vertex], glm::dvec2(col, row)) > kSamePlace) return false;
        if (!dem_.contains(col, row) || !dem_.is_valid(col, row)) return false;
        const terrain_test::TrueGround ground = dem_.ground(col, row);
        const glm::dvec3 truth = ground.base + ground.up * dem_.height_m[dem_.index(col, row)];
        return glm::distance(truth, mesh_.vertices[vertex]) < kSameHeight_m;
    }
    bool is_facing_up(const Face& face) const {
        const glm::dvec2 b = plan_[face[1]] - plan_[face[0]], c = plan_[face[2]] - plan_[face[0]];
        return b.x * c.y - b.y * c.x < 0.0;  // rows go south
    }
    /// Looks at every sample's surroundings that the edge passes.
    size_t vertices_within(const Edge& edge) const {
        const glm::dvec2 from = plan_[edge.first], way = plan_[edge.second] - from;
        const int steps = static_cast<int>(std::ceil(2.0 * glm::length(way)));
        size_t found = 0;
        Cell last = nearest(from);
        for (int i = 1; i < steps; ++i) {
            const Cell cell = nearest(from + way * (double(i) / steps));
            if (cell == std::exchange(last, cell)) continue;
            const auto there = vertices_at_.find(cell);
            if (there == vertices_at_.end()) continue;
            for (const uint32_t vertex : there->second) {
                const glm::dvec2 offset = plan_[vertex] - from;
                const double along = glm::dot(offset, way) / glm::dot(way, way);
                const double beside = std::abs(offset.x * way.y - offset.y * way.x) / glm::length(way);
                const double margin = kSamePlace / glm::length(way);
                found += beside < kSamePlace && along > margin && along < 1.0 - margin;
            }
        }
        return found;
    }
    bool is_on_rim(const Edge& edge) const {
        const glm::dvec2 low = glm::min(plan_[edge.first], plan_[edge.second]),
                         high = glm::max(plan_[edge.first], plan_[edge.second]);
        return high.x < 0.5 || high.y < 0.5 || low.x > dem_.width - 1.5 || low.y > dem_.height - 1.5;
    }
    bool is_seen(const Edge& edge, const lod::View& view) const {
        constexpr int kSteps = 64;
        for (int i = 0; i <= kSteps; ++i) {
            const glm::dvec3 at =
                glm::mix(mesh_.vertices[edge.first], mesh_.vertices[edge.second], double(i) / kSteps);
            if (terrain_test::is_in_picture(view, terrain_test::projected(view, at))) return true;
        }
        return false;
    }

    const TriangleMesh& mesh_;
    const terrain_test::DemTruth& dem_;
    std::vector<glm::dvec2> plan_;
    std::unordered_map<Cell, std::vector<uint32_t>, CellHash> vertices_at_;
};

}  // namespace sim_test
