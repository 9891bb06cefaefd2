#include "lod/surface/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lod/base/check.h"

namespace lod {

namespace {

constexpr uint32_t kLeafTriangles = 4;
constexpr size_t kMaxDepth = 64;  ///< halving 2^32 triangles needs 32; two entries a level at the most

double squared_distance_to_box(const glm::dvec3& point, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 outside = glm::max(glm::max(low - point, point - high), glm::dvec3(0.0));
    return glm::dot(outside, outside);
}

/// What is still to be visited of a tree, nearest on top.
struct VisitStack {
    struct Entry {
        uint32_t node;
        double distance2;
    };
    std::array<Entry, 2 * kMaxDepth> entries;
    size_t count = 0;

    void push(uint32_t node, double distance2) {
        DCHECK(count < entries.size());
        entries[count++] = {node, distance2};
    }
    Entry pop() { return entries[--count]; }
};

/// Depth first, nearer child first, leaving out what is no nearer than the best so far.
template <typename Nodes, typename BoxDistance, typename VisitTriangle>
void descend(const Nodes& nodes, const BoxDistance& box_distance2, double& best2,
             const VisitTriangle& visit) {
    VisitStack stack;
    stack.push(0, box_distance2(nodes[0]));
    while (stack.count > 0) {
        const auto [id, distance2] = stack.pop();
        if (!(distance2 < best2)) continue;
        const auto& node = nodes[id];
        if (node.right == 0) {
            for (uint32_t i = node.begin; i < node.end; ++i) {
                if (visit(i)) return;
            }
            continue;
        }
        const double left2 = box_distance2(nodes[id + 1]), right2 = box_distance2(nodes[node.right]);
        if (left2 <= right2) {
            stack.push(node.right, right2);
            stack.push(id + 1, left2);
        } else {
            stack.push(id + 1, left2);
            stack.push(node.right, right2);
        }
    }
}

}  // namespace

/// Halves the triangles by the place of their middles along the longest side, down to a few.
struct TriangleTree::Builder {
    TriangleTree& tree;
    const Soup& soup;
    std::vector<glm::dvec3> middles;

    void split(uint32_t begin, uint32_t end) {
        const size_t id = tree.nodes_.size();
        Node node;
        node.begin = begin;
        node.end = end;
        node.low = glm::dvec3(std::numeric_limits<double>::infinity());
        node.high = -node.low;
        glm::dvec3 low = node.low, high = node.high;  // of the middles
        for (uint32_t i = begin; i < end; ++i) {
            const Triangle t = soup.triangle(tree.original_[i]);
            node.low = glm::min(node.low, glm::min(t.a, glm::min(t.b, t.c)));
            node.high = glm::max(node.high, glm::max(t.a, glm::max(t.b, t.c)));
            low = glm::min(low, middles[tree.original_[i]]);
            high = glm::max(high, middles[tree.original_[i]]);
        }
        tree.nodes_.push_back(node);
        if (end - begin <= kLeafTriangles) return;
        const glm::dvec3 extent = high - low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
        const uint32_t middle = begin + (end - begin) / 2;
        const auto first = tree.original_.begin();
        std::nth_element(first + begin, first + middle, first + end, [&](uint32_t a, uint32_t b) {
            const double at = middles[a][axis], bt = middles[b][axis];
            return at < bt || (at == bt && a < b);
        });
        split(begin, middle);
        tree.nodes_[id].right = static_cast<uint32_t>(tree.nodes_.size());
        split(middle, end);
    }
};

TriangleTree::TriangleTree(const Soup& soup) {
    const uint32_t count = static_cast<uint32_t>(soup.triangles.size());
    original_.resize(count);
    std::iota(original_.begin(), original_.end(), 0u);
    if (count == 0) return;
    Builder builder{*this, soup, std::vector<glm::dvec3>(count)};
    for (uint32_t i = 0; i < count; ++i) {
        const Triangle t = soup.triangle(i);
        builder.middles[i] = (t.a + t.b + t.c) / 3.0;
    }
    nodes_.reserve(count);
    builder.split(0, count);
    triangles_.resize(count);
    place_.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        triangles_[i] = soup.triangle(original_[i]);
        place_[original_[i]] = i;
    }
}

TriangleHit TriangleTree::nearest(const glm::dvec3& point, double limit_m) const {
    if (is_empty()) return {};
    double best2 = limit_m * limit_m;
    uint32_t found = 0xffffffffu;
    descend(
        nodes_, [&](const Node& node) { return squared_distance_to_box(point, node.low, node.high); }, best2,
        [&](uint32_t i) {
            const double distance2 = squared_distance(point, triangles_[i]);
            if (distance2 < best2) {
                best2 = distance2;
                found = i;
            }
            return best2 == 0.0;
        });
    if (found == 0xffffffffu) return {};
    return {original_[found], std::sqrt(best2)};
}

TriangleHit TriangleTree::cover(const Triangle& corners, double enough_m, uint32_t hint) const {
    if (is_empty()) return {};
    const double enough2 = enough_m * enough_m;
    double best2 = std::numeric_limits<double>::infinity();
    uint32_t found = 0;
    const auto visit = [&](uint32_t i) {
        double farthest2 = 0.0;
        for (const glm::dvec3* corner : {&corners.a, &corners.b, &corners.c}) {
            farthest2 = std::max(farthest2, squared_distance(*corner, triangles_[i]));
            if (farthest2 >= best2) return false;
        }
        best2 = farthest2;
        found = i;
        return best2 <= enough2;
    };
    const bool is_done = hint < place_.size() && visit(place_[hint]);
    if (!is_done) {
        const auto box_distance2 = [&](const Node& node) {
            return std::max({squared_distance_to_box(corners.a, node.low, node.high),
                             squared_distance_to_box(corners.b, node.low, node.high),
                             squared_distance_to_box(corners.c, node.low, node.high)});
        };
        descend(nodes_, box_distance2, best2, visit);
    }
    return {original_[found], std::sqrt(best2)};
}

}  // namespace lod
