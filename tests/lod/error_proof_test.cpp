// Proved errors beside measured ones: random fronts, sampled on faces, edges
// and borders, both ways.
#include "lod/progressive/error_proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lod/base/rng.h"
#include "lod/progressive/build_hierarchy.h"
#include "lod/progressive/static_mesh.h"
#include "lod/progressive/surface_image.h"
#include "lod/surface/surface_distance.h"
#include "tests/lod/mesh_shapes.h"

namespace {

using lod::NodeId;
using lod::VertexHierarchy;
using Corners = std::array<NodeId, 3>;

VertexHierarchy built(const lod::SurfaceMesh& mesh) {
    lod::MeshReport report;
    return *lod::build_hierarchy(mesh, {}, report);
}

/// A front as plainly as can be: triangles with their nodes. A collapse may
/// happen when every triangle of its star is there with the corners that the
/// build saw.
class PlainFront {
  public:
    explicit PlainFront(const VertexHierarchy& h) : h_(h), now_(h.triangles), stars_(h.collapse_count()) {
        std::vector<Corners> build = h.triangles;
        for (uint32_t k = 0; k < h.collapse_count(); ++k) {
            for (uint32_t t : star_triangles(k))
                stars_[k].emplace_back(t, build[t]);
            for (uint32_t i = h.kept_begin[2 * k]; i < h.kept_begin[2 * k + 2]; ++i)
                build[h.kept[i] / 3][h.kept[i] % 3] = h.leaf_count + k;
        }
        is_gone_.resize(now_.size(), 0);
    }

    bool collapse(uint32_t k) {
        for (const auto& [triangle, corners] : stars_[k])
            if (is_gone_[triangle] || now_[triangle] != corners) return false;
        for (uint32_t i = h_.removed_begin[k]; i < h_.removed_begin[k + 1]; ++i)
            is_gone_[h_.removed[i]] = 1;
        for (uint32_t i = h_.kept_begin[2 * k]; i < h_.kept_begin[2 * k + 2]; ++i)
            now_[h_.kept[i] / 3][h_.kept[i] % 3] = h_.leaf_count + k;
        return true;
    }

    std::vector<Corners> triangles() const {
        std::vector<Corners> left;
        for (size_t t = 0; t < now_.size(); ++t)
            if (!is_gone_[t]) left.push_back(now_[t]);
        return left;
    }

  private:
    std::vector<uint32_t> star_triangles(uint32_t k) const {
        std::vector<uint32_t> star(h_.removed.begin() + h_.removed_begin[k],
                                   h_.removed.begin() + h_.removed_begin[k + 1]);
        for (uint32_t i = h_.kept_begin[2 * k]; i < h_.kept_begin[2 * k + 2]; ++i)
            star.push_back(h_.kept[i] / 3);
        return star;
    }

    const VertexHierarchy& h_;
    std::vector<Corners> now_;
    std::vector<std::vector<std::pair<uint32_t, Corners>>> stars_;
    std::vector<uint8_t> is_gone_;
};

glm::dvec3 place(const VertexHierarchy& h, NodeId node) {
    return glm::dvec3(h.position[node]);
}

lod::Triangle triangle_of(const VertexHierarchy& h, const Corners& t) {
    return {place(h, t[0]), place(h, t[1]), place(h, t[2])};
}

/// Points all over a triangle: corners, edges, inside.
std::vector<glm::dvec3> samples_of(const lod::Triangle& t, int cuts) {
    std::vector<glm::dvec3> samples;
    for (int i = 0; i <= cuts; ++i)
        for (int j = 0; i + j <= cuts; ++j)
            samples.push_back(t.a + (t.b - t.a) * (double(i) / cuts) + (t.c - t.a) * (double(j) / cuts));
    return samples;
}

double distance_to(const glm::dvec3& point, const VertexHierarchy& h, const std::vector<Corners>& triangles) {
    double least2 = INFINITY;
    for (const Corners& t : triangles)
        least2 = std::min(least2, lod::squared_distance(point, triangle_of(h, t)));
    return std::sqrt(least2);
}

using Edge = std::pair<NodeId, NodeId>;

std::vector<Edge> borders_of(const std::vector<Corners>& triangles) {
    std::map<Edge, int> uses;
    for (const Corners& t : triangles)
        for (size_t k = 0; k < 3; ++k)
            ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    std::vector<Edge> borders;
    for (const auto& [edge, count] : uses)
        if (count == 1) borders.push_back(edge);
    return borders;
}

double distance_to_border(const glm::dvec3& point, const VertexHierarchy& h,
                          const std::vector<Edge>& border) {
    double least2 = INFINITY;
    for (const auto& [a, b] : border)
        least2 = std::min(
            least2, lod::squared_distance(point, lod::nearest_on_segment(point, place(h, a), place(h, b))));
    return std::sqrt(least2);
}

/// The largest error of a front's nodes that is not reached by any sample, and
/// samples that go beyond.
void expect_within(const VertexHierarchy& h, const std::vector<Corners>& front, const std::string& where) {
    constexpr double kRounding = 1e-9;
    double bound = 0.0;
    for (const Corners& t : front) {
        const NodeId maker = *std::max_element(t.begin(), t.end());
        bound = std::max(bound, double(h.error_m[maker]));
        for (const glm::dvec3& sample : samples_of(triangle_of(h, t), 5))
            ASSERT_LE(distance_to(sample, h, h.triangles), double(h.error_m[maker]) + kRounding) << where;
    }
    for (const Corners& t : h.triangles)
        for (const glm::dvec3& sample : samples_of(triangle_of(h, t), 3))
            ASSERT_LE(distance_to(sample, h, front), bound + kRounding) << where;
    const std::vector<Edge> full_border = borders_of(h.triangles), border = borders_of(front);
    ASSERT_EQ(full_border.empty(), border.empty()) << where;
    for (const bool is_full : {true, false}) {
        for (const auto& [a, b] : is_full ? full_border : border) {
            for (int i = 0; i <= 8; ++i) {
                const glm::dvec3 sample = place(h, a) + (place(h, b) - place(h, a)) * (i / 8.0);
                ASSERT_LE(distance_to_border(sample, h, is_full ? border : full_border), bound + kRounding)
                    << where;
            }
        }
    }
}

/// Shapes with everything that the proof tells apart.
std::vector<std::pair<std::string, lod::SurfaceMesh>> shapes() {
    lod::SurfaceMesh holed = lod_test::waves(12, 12);
    std::erase_if(holed.triangles, [&holed](const auto& t) {
        const glm::vec3& p = holed.positions[t[0]];
        return p.x > 0.3f && p.x < 0.6f && p.y > 0.4f && p.y < 0.7f;
    });
    const auto disc = lod_test::parametric(30, 5, [](double u, double v) {
        return glm::dvec3(v * std::cos(lod_test::kTurn * (u - std::floor(u))),
                          v * std::sin(lod_test::kTurn * (u - std::floor(u))), 0.1 * v * v);
    });
    const auto ribbon = lod_test::parametric(30, 2, [](double u, double v) {
        return glm::dvec3(std::cos(5.0 * u), std::sin(5.0 * u), 0.3 * v + 0.1 * u);
    });
    return {{"waves", lod_test::waves(14, 14)},
            {"torus", lod_test::torus(20, 12)},
            {"box", lod_test::box(4)},
            {"disc", disc},
            {"holed", holed},
            {"ribbon", ribbon}};
}

TEST(ErrorProof, RandomFrontsStayWithin) {
    for (const auto& [name, mesh] : shapes()) {
        const VertexHierarchy h = built(mesh);
        for (uint64_t seed = 0; seed < 4; ++seed) {
            lod::Rng rng(seed);
            const double share = seed == 0 ? 1.0 : rng.unit();  // also the coarsest
            PlainFront front(h);
            for (uint32_t k = 0; k < h.collapse_count(); ++k)
                if (rng.unit() < std::sqrt(share)) front.collapse(k);
            expect_within(h, front.triangles(), name + ", seed " + std::to_string(seed));
            if (HasFatalFailure()) return;
        }
    }
}

TEST(ErrorProof, ImageIsSoundAfterEveryCollapse) {
    for (const auto& [name, mesh] : shapes()) {
        const VertexHierarchy h = built(mesh);
        lod::SurfaceImage image(std::span(h.position).first(h.leaf_count), h.triangles);
        lod::StarMeasures measures;
        ASSERT_TRUE(image.is_sound()) << name;
        for (uint32_t k = 0; k < h.collapse_count(); ++k) {
            image.collapse(lod::step_of(h, k), measures);
            ASSERT_TRUE(image.is_sound()) << name << ", collapse " << k;
        }
    }
}

TEST(ErrorProof, PlanesHaveNoError) {
    for (const auto& mesh : {lod_test::plane(20, 20), lod_test::plane(7, 31)}) {
        const VertexHierarchy h = built(mesh);
        EXPECT_LE(lod::mesh_at_tolerance(h, 0.0).triangles.size(), 2u);
        // Only giving up a corner of the outline is an error.
        EXPECT_LE(
            std::count_if(h.error_m.begin(), h.error_m.end(), [](float error_m) { return error_m > 0.0f; }),
            2);
    }
}

/// Close to what is true: a bound that is twice too large costs triangles.
TEST(ErrorProof, BoundsAreTight) {
    for (const auto& mesh : {lod_test::torus(60, 40), lod_test::waves(50, 50)}) {
        const VertexHierarchy h = built(mesh);
        std::vector<glm::dvec3> places;
        for (const glm::vec3& p : h.position)
            places.emplace_back(p);
        for (const size_t part : {size_t{4}, size_t{16}}) {
            const lod::ScaledHierarchy one{&h};
            const lod::StaticMesh state = lod::meshes_of_size({&one, 1}, h.triangles.size() / part)[0];
            std::vector<Corners> triangles;
            for (const auto& t : state.triangles)
                triangles.push_back({h.vertex_node[t[0]], h.vertex_node[t[1]], h.vertex_node[t[2]]});
            const lod::Soup full{places, h.triangles}, coarse{places, triangles};
            const double slack_m = 0.1 * state.error_m;
            const lod::DistanceBounds measured = lod::two_sided_distance(full, coarse, slack_m, 1);
            EXPECT_LE(measured.lower_m, state.error_m);
            EXPECT_GE(2.0 * measured.upper_m, state.error_m) << "1 / " << part;
        }
    }
}

TEST(ErrorProof, ErrorsRiseToTheRoots) {
    const VertexHierarchy h = built(lod_test::waves(20, 20));
    for (uint32_t node = 0; node < h.node_count(); ++node) {
        if (node < h.leaf_count) {
            EXPECT_EQ(h.error_m[node], 0.0f);
        }
        if (h.parent[node] != lod::kNoNode) {
            EXPECT_LE(h.error_m[node], h.error_m[h.parent[node]]);
        }
    }
}

}  // namespace
