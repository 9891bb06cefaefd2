// The plain builder that the tests of fronts stand on (plain_hierarchy.h), and a look at what it makes.
#include "tests/lod/plain_hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "lod/base/rng.h"
#include "lod/draw_list.h"

namespace lod_test {
namespace {

using lod::NodeId;

struct Workbench {
    std::vector<std::array<NodeId, 3>> corners;
    std::vector<bool> is_there;            ///< [triangles]
    std::vector<std::set<uint32_t>> star;  ///< [nodes] triangles
    std::set<std::tuple<float, NodeId, NodeId>> edges;
    PlainHistory out;

    lod::VertexHierarchy& h() { return out.hierarchy; }
    const std::vector<glm::vec3>& at() const { return out.hierarchy.position; }

    std::set<NodeId> ring(NodeId node) const {
        std::set<NodeId> found;
        for (uint32_t t : star[node])
            found.insert(corners[t].begin(), corners[t].end());
        found.erase(node);
        return found;
    }
    bool is_border(NodeId node) const {
        std::map<NodeId, int> uses;
        for (uint32_t t : star[node]) {
            for (NodeId corner : corners[t])
                ++uses[corner];
        }
        return std::any_of(uses.begin(), uses.end(),
                           [&](const auto& use) { return use.first != node && use.second == 1; });
    }
    void offer(NodeId a, NodeId b) {
        edges.insert({glm::distance(at()[a], at()[b]), std::min(a, b), std::max(a, b)});
    }
};

glm::vec3 area_normal(const Workbench& bench, const std::array<NodeId, 3>& corners) {
    const glm::vec3 a = bench.at()[corners[0]], b = bench.at()[corners[1]], c = bench.at()[corners[2]];
    return glm::cross(b - a, c - a);
}

std::array<NodeId, 3> renamed(std::array<NodeId, 3> corners, NodeId from, NodeId to) {
    std::replace(corners.begin(), corners.end(), from, to);
    return corners;
}

/// Whether b may move to a's place: the surface stays one (link condition), no border is pinched, nothing turns.
bool may_go(const Workbench& bench, NodeId a, NodeId b) {
    const std::set<NodeId> ring_a = bench.ring(a), ring_b = bench.ring(b);
    std::vector<NodeId> both;
    std::set_intersection(ring_a.begin(), ring_a.end(), ring_b.begin(), ring_b.end(),
                          std::back_inserter(both));
    std::vector<uint32_t> between;
    std::set_intersection(bench.star[a].begin(), bench.star[a].end(), bench.star[b].begin(),
                          bench.star[b].end(), std::back_inserter(between));
    if (both.size() != between.size() || bench.star[a].size() + bench.star[b].size() < 2 * between.size() + 3)
        return false;
    if (between.size() == 2 && bench.is_border(a) && bench.is_border(b)) return false;
    if (between.size() == 1 && bench.ring(both[0]).size() <= 2) return false;
    for (uint32_t t : bench.star[b]) {
        const std::array<NodeId, 3> then = bench.corners[t], now = renamed(then, b, a);
        if (std::find(then.begin(), then.end(), a) != then.end()) continue;
        const glm::vec3 n = area_normal(bench, then), m = area_normal(bench, now);
        if (!(glm::dot(n, m) > 0.5f * glm::length(n) * glm::length(m))) return false;
    }
    return true;
}

SeenTriangle seen(uint32_t t, const std::array<NodeId, 3>& corners) {
    return {t, corners[0], corners[1], corners[2]};
}

void collapse(Workbench& bench, NodeId a, NodeId b) {
    lod::VertexHierarchy& h = bench.h();
    const NodeId p = h.node_count();
    h.position.push_back(glm::vec3(h.position[a]));
    h.parent.push_back(lod::kNoNode);
    h.parent[a] = h.parent[b] = p;
    h.children.push_back({a, b});
    bench.star.emplace_back();
    std::set<SeenTriangle> before, after;
    for (NodeId child : {a, b}) {
        for (uint32_t t : bench.star[child])
            before.insert(seen(t, bench.corners[t]));
    }
    for (NodeId child : {a, b}) {
        const NodeId other = child == a ? b : a;
        for (uint32_t t : bench.star[child]) {
            std::array<NodeId, 3>& corners = bench.corners[t];
            if (std::find(corners.begin(), corners.end(), other) != corners.end()) {
                if (child == a) h.removed.push_back(t);
                continue;
            }
            const auto place = std::find(corners.begin(), corners.end(), child);
            h.kept.push_back(3 * t + static_cast<uint32_t>(place - corners.begin()));
        }
        h.kept_begin.push_back(static_cast<uint32_t>(h.kept.size()));
    }
    h.removed_begin.push_back(static_cast<uint32_t>(h.removed.size()));
    const uint32_t first_removed = *(h.removed_begin.end() - 2);
    for (size_t i = first_removed; i < h.removed.size(); ++i) {
        for (NodeId corner : bench.corners[h.removed[i]])
            bench.star[corner].erase(h.removed[i]);
    }
    for (NodeId child : {a, b}) {
        for (uint32_t t : bench.star[child]) {
            bench.corners[t] = renamed(bench.corners[t], child, p);
            bench.star[p].insert(t);
            after.insert(seen(t, bench.corners[t]));
        }
        bench.star[child].clear();
    }
    bench.out.seen.insert(after.begin(), after.end());
    bench.out.before.push_back(std::move(before));
    bench.out.after.push_back(std::move(after));
    for (NodeId neighbour : bench.ring(p))
        bench.offer(p, neighbour);
}

/// error: the farthest that a leaf is from the node that stands for it, and no less than that of any neighbour at its
/// birth. Then on every triangle the youngest corner knows the largest error of the three, and its sphere holds it.
void bound_all(Workbench& bench) {
    lod::VertexHierarchy& h = bench.h();
    std::vector<std::vector<NodeId>> leaves(h.node_count());
    std::vector<std::vector<uint32_t>> full_star(h.leaf_count);
    for (uint32_t t = 0; t < h.triangles.size(); ++t) {
        for (NodeId leaf : h.triangles[t])
            full_star[leaf].push_back(t);
    }
    h.error_m.assign(h.node_count(), 0.0f);
    for (NodeId node = 0; node < h.node_count(); ++node) {
        std::vector<glm::vec3> points{h.position[node]};
        if (node < h.leaf_count) {
            leaves[node] = {node};
        } else {
            const uint32_t k = node - h.leaf_count;
            for (NodeId child : h.children[k]) {
                leaves[node].insert(leaves[node].end(), leaves[child].begin(), leaves[child].end());
                h.error_m[node] = std::max(h.error_m[node], h.error_m[child]);
            }
            for (const auto& [t, a, b, c] : bench.out.after[k]) {
                for (NodeId corner : {a, b, c}) {
                    points.push_back(h.position[corner]);
                    h.error_m[node] = std::max(h.error_m[node], h.error_m[corner]);
                }
            }
        }
        for (NodeId leaf : leaves[node]) {
            h.error_m[node] =
                std::max(h.error_m[node], glm::distance(h.position[leaf], h.position[node]) * 1.000001f);
            for (uint32_t t : full_star[leaf]) {
                for (NodeId corner : h.triangles[t])
                    points.push_back(h.position[corner]);
            }
        }
        glm::vec3 low = points[0], high = points[0];
        for (const glm::vec3& point : points) {
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
        h.centre.push_back((low + high) * 0.5f);
        float radius = 0.0f;
        for (const glm::vec3& point : points)
            radius = std::max(radius, glm::distance(point, h.centre[node]));
        h.radius_m.push_back(radius * 1.00001f);
        h.cone_axis.emplace_back(0.0f, 0.0f, 1.0f);
        h.cone_cos.push_back(-1.0f);
    }
}

}  // namespace

PlainHistory make_plain_history(const PlainMesh& mesh) {
    Workbench bench;
    lod::VertexHierarchy& h = bench.h();
    h.leaf_count = static_cast<uint32_t>(mesh.positions.size());
    h.position = mesh.positions;
    h.triangles = bench.corners = mesh.triangles;
    h.parent.assign(h.leaf_count, lod::kNoNode);
    h.removed_begin = h.kept_begin = {0};
    bench.star.resize(h.leaf_count);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        bench.out.seen.insert(seen(t, bench.corners[t]));
        for (size_t corner = 0; corner < 3; ++corner) {
            bench.star[bench.corners[t][corner]].insert(t);
            bench.offer(bench.corners[t][corner], bench.corners[t][(corner + 1) % 3]);
        }
    }
    while (!bench.edges.empty()) {
        auto [length, a, b] = *bench.edges.begin();
        bench.edges.erase(bench.edges.begin());
        if (h.parent[a] != lod::kNoNode || h.parent[b] != lod::kNoNode) continue;
        if (bench.is_border(b)) std::swap(a, b);
        if (may_go(bench, a, b)) collapse(bench, a, b);
    }
    h.triangle_vertices = h.triangles;
    for (NodeId node = 0; node < h.node_count(); ++node)
        h.vertex_node.push_back(node);
    for (uint32_t k = 0; k < h.collapse_count(); ++k) {
        for (uint32_t i = h.kept_begin[2 * k]; i < h.kept_begin[2 * k + 2]; ++i) {
            const bool is_first = i < h.kept_begin[2 * k + 1];
            h.kept_vertex.push_back({h.children[k][is_first ? 0 : 1], h.leaf_count + k});
        }
    }
    h.normal.assign(h.node_count(), {0, 0, 1});
    h.colour.assign(h.node_count(), {200, 200, 200, static_cast<uint8_t>(lod::Material::kPaint)});
    bound_all(bench);
    return std::move(bench.out);
}

PlainMesh bumpy_sheet(uint32_t n, uint64_t seed) {
    lod::Rng rng(seed);
    PlainMesh mesh;
    for (uint32_t y = 0; y < n; ++y) {
        for (uint32_t x = 0; x < n; ++x) {
            const double u = (x + rng.between(-0.3, 0.3)) / n, v = (y + rng.between(-0.3, 0.3)) / n;
            mesh.positions.emplace_back(
                u, v, 0.05 * std::sin(9.0 * u) * std::cos(7.0 * v) + rng.between(0, 0.2 / n));
            if (x + 1 == n || y + 1 == n) continue;
            const uint32_t i = y * n + x;
            mesh.triangles.push_back({i, i + 1, i + n + 1});
            mesh.triangles.push_back({i, i + n + 1, i + n});
        }
    }
    return mesh;
}

PlainMesh bumpy_ring(uint32_t n, uint32_t m, uint64_t seed) {
    lod::Rng rng(seed);
    PlainMesh mesh;
    for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < m; ++j) {
            const double u = 2.0 * std::numbers::pi * (i + rng.between(-0.2, 0.2)) / n;
            const double v = 2.0 * std::numbers::pi * (j + rng.between(-0.2, 0.2)) / m;
            const double r = 0.3 * rng.between(0.97, 1.03), away = 1.0 + r * std::cos(v);
            mesh.positions.emplace_back(away * std::cos(u), away * std::sin(u), r * std::sin(v));
            const uint32_t next_i = (i + 1) % n, next_j = (j + 1) % m;
            mesh.triangles.push_back({i * m + j, next_i * m + j, next_i * m + next_j});
            mesh.triangles.push_back({i * m + j, next_i * m + next_j, i * m + next_j});
        }
    }
    return mesh;
}

PlainMesh joined(const PlainMesh& a, const PlainMesh& b) {
    PlainMesh both = a;
    const uint32_t first = static_cast<uint32_t>(a.positions.size());
    for (const glm::vec3& position : b.positions)
        both.positions.push_back(position + glm::vec3(3.0f, 0.0f, 0.0f));
    for (const auto& [i, j, k] : b.triangles)
        both.triangles.push_back({i + first, j + first, k + first});
    return both;
}

TEST(PlainHierarchy, CollapsesMostOfASheetAndARing) {
    const PlainHistory sheet = make_plain_history(bumpy_sheet(20, 1));
    EXPECT_GT(sheet.hierarchy.collapse_count(), 300u);
    const PlainHistory ring = make_plain_history(bumpy_ring(30, 12, 1));
    EXPECT_GT(ring.hierarchy.collapse_count(), 250u);
    EXPECT_EQ(ring.before.size(), ring.hierarchy.collapse_count());
}

}  // namespace lod_test
