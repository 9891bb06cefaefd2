#include "lod/progressive/mesh_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"
#include "lod/progressive/part_breadth.h"

namespace lod {
namespace {

/// The lists of each collapse, side by side; the hierarchy gives them up.
void gather_lists(ProgressiveMesh& mesh) {
    VertexHierarchy& h = mesh.hierarchy;
    mesh.lists.reserve(3 * h.kept.size() + h.removed.size());
    for (uint32_t k = 0; k < h.collapse_count(); ++k) {
        const uint32_t begin = h.kept_begin[2 * k], middle = h.kept_begin[2 * k + 1],
                       end = h.kept_begin[2 * k + 2];
        const NodeId node = h.leaf_count + k;
        const auto [a, b] = h.children[k];
        mesh.heads.push_back({.children = h.children[k],
                              .parent = h.parent[node],
                              .begin = static_cast<uint32_t>(mesh.lists.size()),
                              .kept_count = {middle - begin, end - middle},
                              .removed_count = h.removed_begin[k + 1] - h.removed_begin[k],
                              .way_m = std::max(glm::distance(h.position[a], h.position[node]),
                                                glm::distance(h.position[b], h.position[node]))});
        for (uint32_t i = begin; i < end; ++i)
            mesh.lists.push_back(h.kept[i]);
        for (uint32_t i = h.removed_begin[k]; i < h.removed_begin[k + 1]; ++i)
            mesh.lists.push_back(h.removed[i]);
        for (uint32_t i = begin; i < end; ++i)
            mesh.lists.insert(mesh.lists.end(), h.kept_vertex[i].begin(), h.kept_vertex[i].end());
    }
    h.kept_begin = {}, h.kept = {}, h.kept_vertex = {}, h.removed_begin = {}, h.removed = {};
}

/// All collapses in their order: what each triangle ends as, and by whom.
void replay(ProgressiveMesh& mesh) {
    const VertexHierarchy& h = mesh.hierarchy;
    mesh.last_corners = h.triangles;
    mesh.last_vertices = h.triangle_vertices;
    mesh.remover.assign(h.triangles.size(), kNoNode);
    for (uint32_t collapse = 0; collapse < h.collapse_count(); ++collapse) {
        const NodeId node = h.leaf_count + collapse;
        for (uint32_t triangle : mesh.removed(collapse))
            mesh.remover[triangle] = node;
        const VertexId* shown = mesh.kept_vertices(collapse);
        for (CornerId corner : mesh.star(node)) {
            mesh.last_corners[corner / 3][corner % 3] = node;
            mesh.last_vertices[corner / 3][corner % 3] = shown[1];
            shown += 2;
        }
    }
}

void index_leaf_corners(ProgressiveMesh& mesh) {
    const VertexHierarchy& h = mesh.hierarchy;
    mesh.leaf_begin.assign(h.leaf_count + 1, 0);
    for (const auto& triangle : h.triangles) {
        for (NodeId leaf : triangle)
            ++mesh.leaf_begin[leaf + 1];
    }
    for (size_t leaf = 0; leaf < h.leaf_count; ++leaf)
        mesh.leaf_begin[leaf + 1] += mesh.leaf_begin[leaf];
    mesh.leaf_corners.resize(3 * h.triangles.size());
    std::vector<uint32_t> next(mesh.leaf_begin.begin(), mesh.leaf_begin.end() - 1);
    for (CornerId corner = 0; corner < mesh.leaf_corners.size(); ++corner)
        mesh.leaf_corners[next[h.triangles[corner / 3][corner % 3]]++] = corner;
}

void index_further_vertices(ProgressiveMesh& mesh) {
    const VertexHierarchy& h = mesh.hierarchy;
    mesh.further_begin.assign(h.node_count() + 1, 0);
    for (VertexId vertex = h.node_count(); vertex < h.vertex_count(); ++vertex)
        ++mesh.further_begin[h.vertex_node[vertex] + 1];
    for (size_t node = 0; node < h.node_count(); ++node)
        mesh.further_begin[node + 1] += mesh.further_begin[node];
    mesh.further_vertices.resize(h.vertex_count() - h.node_count());
    std::vector<uint32_t> next(mesh.further_begin.begin(), mesh.further_begin.end() - 1);
    for (VertexId vertex = h.node_count(); vertex < h.vertex_count(); ++vertex)
        mesh.further_vertices[next[h.vertex_node[vertex]]++] = vertex;
}

void gather_bounds(ProgressiveMesh& mesh) {
    const VertexHierarchy& h = mesh.hierarchy;
    mesh.bounds.resize(h.collapse_count());
    std::vector<double> breadths_m = breadths_of_leaves(h);  // of all nodes, in the end
    for (uint32_t collapse = 0; collapse < h.collapse_count(); ++collapse) {
        const NodeId node = h.leaf_count + collapse;
        const glm::vec3& centre = h.centre[node];
        breadths_m.push_back(breadths_m[h.children[collapse][0]]);
        const double seen_m = seen_error_m(double(h.error_m[node]), breadths_m[node]);
        // The few roundings of the metric (sight_metric.h).
        const float rounding = (std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z)) * 0x1p-22f;
        mesh.bounds[collapse] = {.centre = centre,
                                 .radius_m = (h.radius_m[node] + rounding) * (1.0f + 0x1p-20f),
                                 .error_m = static_cast<float>(seen_m) * (1.0f + 0x1p-20f),
                                 .cone_axis = h.cone_axis[node],
                                 .cone_cos = h.cone_cos[node]};
    }
}

/// Around the box of all positions: a vertex under way is between positions, too.
void enclose(ProgressiveMesh& mesh) {
    const VertexHierarchy& h = mesh.hierarchy;
    if (h.position.empty()) return;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::vec3& position : h.position) {
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    mesh.centre = (low + high) * 0.5;
    for (const glm::vec3& position : h.position)
        mesh.radius_m = std::max(mesh.radius_m, glm::distance(glm::dvec3(position), mesh.centre));
    mesh.radius_m *= 1.0 + 1e-12;
}

}  // namespace

ProgressiveMesh make_progressive_mesh(VertexHierarchy hierarchy, bool is_glass) {
    ProgressiveMesh mesh;
    mesh.is_glass = is_glass;
    mesh.hierarchy = std::move(hierarchy);
    const VertexHierarchy& h = mesh.hierarchy;
    CHECK(h.triangles.size() < kNoNode / 3 && h.parent.size() == h.node_count());
    CHECK(h.kept_begin.size() == 2 * size_t{h.collapse_count()} + 1);
    CHECK(h.removed_begin.size() == size_t{h.collapse_count()} + 1);
    CHECK(h.kept_vertex.size() == h.kept.size() && h.vertex_count() >= h.node_count());
    for (const auto& triangle : h.triangles)
        CHECK(std::max({triangle[0], triangle[1], triangle[2]}) < h.leaf_count);
    index_leaf_corners(mesh);
    index_further_vertices(mesh);
    gather_lists(mesh);
    replay(mesh);
    gather_bounds(mesh);
    enclose(mesh);

    for (NodeId node = 0; node < h.node_count(); ++node) {
        if (h.parent[node] == kNoNode) mesh.roots.push_back(node);
    }
    return mesh;
}

}  // namespace lod
