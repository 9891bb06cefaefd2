// What a build makes of shapes and of nasty soups: valid hierarchies, the borders that were there, nothing turned over.
#include "lod/progressive/build_hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "lod/progressive/hierarchy_check.h"
#include "lod/progressive/static_mesh.h"
#include "tests/lod/mesh_shapes.h"

namespace {

using lod::MeshReport;
using lod::SurfaceMesh;
using lod::VertexHierarchy;

VertexHierarchy built(const SurfaceMesh& mesh, MeshReport& report, const lod::BuildOptions& options = {}) {
    const auto hierarchy = lod::build_hierarchy(mesh, options, report);
    EXPECT_TRUE(hierarchy) << hierarchy.message();
    if (!hierarchy) return {};
    EXPECT_EQ(lod::fault_of(*hierarchy), "");
    return *hierarchy;
}

/// Edges by their number of triangles, from places and not from any array of the build.
std::map<int, int> edges_by_triangles(const VertexHierarchy& h, const lod::StaticMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (const auto& t : mesh.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = h.vertex_node[t[k]], b = h.vertex_node[t[(k + 1) % 3]];
            ++uses[{std::min(a, b), std::max(a, b)}];
        }
    }
    std::map<int, int> counts;
    for (const auto& [edge, count] : uses)
        ++counts[count];
    return counts;
}

/// Nothing turned over, manifold, closed if it was.
void expect_sound(const VertexHierarchy& h, bool is_closed) {
    for (const double share : {0.5, 0.1, 0.02, 0.0}) {
        const lod::ScaledHierarchy one{&h};
        const auto target = static_cast<uint64_t>(share * double(h.triangles.size()));
        const lod::StaticMesh mesh = lod::meshes_of_size({&one, 1}, target)[0];
        EXPECT_EQ(lod::count_flipped(h, mesh), 0u);
        std::map<int, int> edges = edges_by_triangles(h, mesh);
        EXPECT_EQ(edges.size(), static_cast<size_t>((edges.count(1) > 0) + (edges.count(2) > 0)));
        EXPECT_EQ(is_closed && edges.count(1) > 0, false);
    }
}

TEST(BuildHierarchy, TorusWeldsClosedAndCollapsesToAHandful) {
    MeshReport report;
    const VertexHierarchy h = built(lod_test::torus(60, 40), report);
    EXPECT_EQ(report.places, 2400u);
    EXPECT_EQ(report.border_edges, 0u);
    EXPECT_EQ(h.triangles.size(), 4800u);
    EXPECT_LE(lod::mesh_at_tolerance(h, 1e300).triangles.size(), 60u);
    expect_sound(h, true);
}

TEST(BuildHierarchy, BoxKeepsItsHardEdges) {
    MeshReport report;
    const VertexHierarchy h = built(lod_test::box(8), report);
    EXPECT_EQ(report.border_edges, 0u);
    EXPECT_EQ(report.seam_edges, 12u * 8u);
    expect_sound(h, true);
    // Every drawn corner of any state has a normal of the face it lies in: none was mixed across an edge.
    const lod::StaticMesh base = lod::mesh_at_tolerance(h, 0.0);
    EXPECT_EQ(base.triangles.size(), 12u);
    for (const auto& triangle : base.triangles) {
        const glm::vec3 a = h.position[h.vertex_node[triangle[0]]];
        const glm::vec3 face = glm::normalize(glm::cross(h.position[h.vertex_node[triangle[1]]] - a,
                                                         h.position[h.vertex_node[triangle[2]]] - a));
        for (lod::VertexId vertex : triangle)
            EXPECT_GT(glm::dot(face, h.normal[vertex]), 0.999f);
    }
}

TEST(BuildHierarchy, EdgeLengthMetricPutsTheShortestEdgeFirst) {
    SurfaceMesh mesh = lod_test::waves(12, 12);
    mesh.positions[5 * 13 + 5] = mesh.positions[5 * 13 + 6] + glm::vec3(-1e-3f, 0.0f, 0.0f);
    lod::BuildOptions options;
    options.decimate.metric = lod::CollapseMetric::kEdgeLength;
    MeshReport report;
    const VertexHierarchy h = built(mesh, report, options);
    const auto [a, b] = h.children[0];
    EXPECT_LT(glm::length(h.position[a] - h.position[b]), 2e-3f);
    EXPECT_LT(glm::length(h.position[h.leaf_count] - 0.5f * (h.position[a] + h.position[b])), 1e-6f);
    expect_sound(h, false);
}

TEST(BuildHierarchy, SameInputSameHierarchy) {
    MeshReport report, again;
    const VertexHierarchy one = built(lod_test::waves(40, 40), report);
    const VertexHierarchy two = built(lod_test::waves(40, 40), again);
    EXPECT_EQ(one.children, two.children);
    ASSERT_EQ(one.position.size(), two.position.size());
    EXPECT_EQ(std::memcmp(one.position.data(), two.position.data(), one.position.size() * sizeof(glm::vec3)),
              0);
    EXPECT_EQ(one.error_m, two.error_m);
}

TEST(BuildHierarchy, OneThreadAndTwoMakeTheSame) {
    for (const lod::SurfaceMesh& mesh :
         {lod_test::waves(40, 40), lod_test::torus(60, 40), lod_test::box(1)}) {
        MeshReport report;
        lod::BuildOptions options;
        const auto one = lod::build_hierarchy(mesh, options, report);
        options.threads = 2;
        const auto two = lod::build_hierarchy(mesh, options, report);
        ASSERT_TRUE(one && two);
        EXPECT_EQ(one->children, two->children);
        EXPECT_EQ(one->error_m, two->error_m);
        EXPECT_EQ(one->radius_m, two->radius_m);
        EXPECT_EQ(one->cone_cos, two->cone_cos);
    }
}

TEST(BuildHierarchy, ScaleDoesNotMatter) {
    for (const float scale : {1e-9f, 1.0f, 1e6f}) {
        SurfaceMesh mesh = lod_test::torus(30, 20);
        for (glm::vec3& p : mesh.positions)
            p *= scale;
        MeshReport report;
        const VertexHierarchy h = built(mesh, report);
        const lod::StaticMesh base = lod::mesh_at_tolerance(h, 1e300);
        EXPECT_LE(base.triangles.size(), 60u) << scale;
        EXPECT_GT(base.error_m, 0.01 * double(scale));
        EXPECT_LT(base.error_m, 4.0 * double(scale));
        expect_sound(h, true);
    }
}

TEST(BuildHierarchy, WeldsByTolerance) {
    SurfaceMesh mesh = lod_test::torus(24, 16);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.positions[i] += 1e-5f * glm::vec3(float(i % 3) - 1.0f, float(i % 5) - 2.0f, 0.0f);
    MeshReport exact, within;
    built(mesh, exact);
    EXPECT_GT(exact.border_edges, 0u);
    built(mesh, within, {.weld_m = 1e-3, .decimate = {}});
    EXPECT_EQ(within.border_edges, 0u);
    EXPECT_EQ(within.places, 24u * 16u);
}

TEST(BuildHierarchy, ThreeSheetsAtAnEdgeStayTogether) {
    // A fan of three subdivided leaves along one line, as the pages of a book.
    SurfaceMesh mesh;
    for (int page = 0; page < 3; ++page) {
        const double angle = 2.0 * page;
        const SurfaceMesh leaf = lod_test::parametric(10, 10, [=](double u, double v) {
            return glm::dvec3(u * std::cos(angle), u * std::sin(angle), v);
        });
        const auto base = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), leaf.positions.begin(), leaf.positions.end());
        mesh.normals.insert(mesh.normals.end(), leaf.normals.begin(), leaf.normals.end());
        mesh.colours.insert(mesh.colours.end(), leaf.colours.begin(), leaf.colours.end());
        for (auto t : leaf.triangles)
            mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
    MeshReport report;
    const VertexHierarchy h = built(mesh, report);
    EXPECT_EQ(report.non_manifold_edges, 10u);
    const lod::StaticMesh base = lod::mesh_at_tolerance(h, 1e300);
    std::map<float, int> pages_at;  // how many nodes stand at each place of the spine
    std::set<lod::NodeId> nodes;
    for (const auto& triangle : base.triangles)
        for (lod::VertexId vertex : triangle)
            nodes.insert(h.vertex_node[vertex]);
    for (lod::NodeId node : nodes)
        if (h.position[node].x == 0.0f && h.position[node].y == 0.0f) ++pages_at[h.position[node].z];
    EXPECT_EQ(pages_at.size(), 11u);
    for (const auto& [z, count] : pages_at)
        EXPECT_GE(count, 2) << z;
}

TEST(BuildHierarchy, NastySoups) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    MeshReport report;
    const auto refused =
        lod::build_hierarchy(lod_test::soup({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, {{0, 1, 2}}), {}, report);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.message(), "vertex 2 has a coordinate that is no number; expected finite ones");
    EXPECT_FALSE(lod::build_hierarchy(lod_test::soup({{0, 0, 0}}, {}), {}, report));
    EXPECT_FALSE(lod::build_hierarchy(lod_test::soup({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}), {}, report));
    EXPECT_FALSE(lod::build_hierarchy(lod_test::soup({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 7}}), {}, report));

    report = {};
    const VertexHierarchy one = built(lod_test::soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), report);
    EXPECT_EQ(lod::mesh_at_tolerance(one, 1e300).triangles.size(), 1u);

    report = {};  // twice the same, a reverse, a line, a point, and another far away
    const VertexHierarchy mixed =
        built(lod_test::soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {9, 9, 9}, {9, 8, 9}, {8, 9, 9}},
                             {{0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {0, 1, 3}, {1, 1, 2}, {4, 5, 6}}),
              report);
    EXPECT_EQ(report.duplicate_faces, 1u);
    EXPECT_EQ(report.collapsed_faces, 1u);
    EXPECT_EQ(report.zero_area_faces, 1u);
    EXPECT_EQ(mixed.triangles.size(), 4u);
    EXPECT_EQ(report.components, 3u);
}

}  // namespace
