#include "lod/surface/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lod/base/check.h"

namespace lod {

namespace {

constexpr uint32_t kNothing = 0xffffffffu;
constexpr uint32_t kLeafTriangles =
    1;  ///< more cost a quarter more time: a box of its own keeps most from being asked
constexpr size_t kMaxDepth = 64;  ///< halving 2^32 triangles needs 32; two entries a level at the most

inline double squared_distance_to_box(const glm::dvec3& point, const glm::dvec3& low,
                                      const glm::dvec3& high) {
    const double x = std::max(std::max(low.x - point.x, point.x - high.x), 0.0);
    const double y = std::max(std::max(low.y - point.y, point.y - high.y), 0.0);
    const double z = std::max(std::max(low.z - point.z, point.z - high.z), 0.0);
    return x * x + y * y + z * z;
}

double longest_edge_m(const Triangle& t) {
    return std::sqrt(
        std::max({squared_distance(t.a, t.b), squared_distance(t.b, t.c), squared_distance(t.c, t.a)}));
}

constexpr double kBeyondTheWay = 2.0;  ///< no share of it
constexpr double kSlack = 1e-9;        ///< of a way: boxes are as flat as what is in them

constexpr double kNever =
    1e300;  ///< per way where there is none along an axis; not infinity: 0 times it is 0

/// From one point straight to another, and the box around it.
struct Way {
    glm::dvec3 from, along, per, low, high;  ///< per: 1 / along

    Way(const glm::dvec3& start, const glm::dvec3& end)
        : from(start), along(end - start), low(glm::min(start, end)), high(glm::max(start, end)) {
        for (int axis = 0; axis < 3; ++axis)
            per[axis] = std::clamp(1.0 / along[axis], -kNever, kNever);
        const glm::dvec3 slack = kSlack * (high - low);
        low -= slack;
        high += slack;
    }
};

/// The share of a way at which it enters a box.
double share_to_box(const Way& way, const glm::dvec3& low, const glm::dvec3& high) {
    if (low.x > way.high.x || high.x < way.low.x || low.y > way.high.y || high.y < way.low.y ||
        low.z > way.high.z || high.z < way.low.z)
        return kBeyondTheWay;
    const glm::dvec3 a = (low - way.from) * way.per, b = (high - way.from) * way.per;
    const glm::dvec3 first = glm::min(a, b), last = glm::max(a, b);
    const double begin = std::max(std::max(first.x, first.y), std::max(first.z, kSlack)) - kSlack;
    const double end = std::min(std::min(last.x, last.y), std::min(last.z, 1.0 - kSlack)) + kSlack;
    return begin <= end ? begin : kBeyondTheWay;
}

/// The share of a way at which it meets a triangle.
/// Source: Möller, Trumbore, Fast, minimum storage ray/triangle intersection (1997).
double share_to_triangle(const Way& way, const Triangle& t) {
    const glm::dvec3 ab = t.b - t.a, ac = t.c - t.a, across = glm::cross(way.along, ac);
    const double volume = glm::dot(ab, across);
    if (volume == 0.0) return kBeyondTheWay;
    const glm::dvec3 at = way.from - t.a, along = glm::cross(at, ab);
    const double b = glm::dot(at, across) / volume, c = glm::dot(way.along, along) / volume,
                 share = glm::dot(ac, along) / volume;
    const bool is_met = b >= 0.0 && c >= 0.0 && b + c <= 1.0 && share >= 0.0 && share <= 1.0;
    return is_met ? share : kBeyondTheWay;
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
        const double hidden2 = std::numeric_limits<double>::infinity();
        const double left2 = nodes[id + 1].is_shown ? box_distance2(nodes[id + 1]) : hidden2;
        const double right2 = nodes[node.right].is_shown ? box_distance2(nodes[node.right]) : hidden2;
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
            node.longest_m = std::max(node.longest_m, longest_edge_m(t));
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
    is_shown_.assign(count, 1);
    for (uint32_t i = 0; i < count; ++i) {
        triangles_[i] = soup.triangle(original_[i]);
        place_[original_[i]] = i;
    }
}

void TriangleTree::hide_all() {
    std::fill(is_shown_.begin(), is_shown_.end(), uint8_t{0});
    for (Node& node : nodes_)
        node.is_shown = false;
}

void TriangleTree::show(uint32_t triangle) {
    const uint32_t place = place_[triangle];
    is_shown_[place] = 1;
    for (uint32_t id = 0;;) {
        nodes_[id].is_shown = true;
        if (nodes_[id].right == 0) return;
        id = place < nodes_[nodes_[id].right].begin ? id + 1 : nodes_[id].right;
    }
}

TriangleHit TriangleTree::nearest(const glm::dvec3& point, double limit_m) const {
    if (is_empty()) return {};
    double best2 = limit_m * limit_m;
    uint32_t found = kNothing;
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
    if (found == kNothing) return {};
    return {original_[found], std::sqrt(best2)};
}

TriangleHit TriangleTree::any_within(const glm::dvec3& point, double limit_m) const {
    if (is_empty()) return {};
    const double limit2 = limit_m * limit_m;
    double best2 = std::nextafter(limit2, std::numeric_limits<double>::infinity());
    uint32_t found = kNothing;
    descend(
        nodes_, [&](const Node& node) { return squared_distance_to_box(point, node.low, node.high); }, best2,
        [&](uint32_t i) {
            if (!is_shown_[i]) return false;
            const double distance2 = squared_distance(point, triangles_[i]);
            if (distance2 > limit2) return false;
            best2 = distance2;
            found = i;
            return true;
        });
    if (found == kNothing) return {};
    return {original_[found], std::sqrt(best2)};
}

TriangleHit TriangleTree::on_way(const glm::dvec3& from, const glm::dvec3& to, double enough) const {
    if (is_empty()) return {};
    const Way way(from, to);
    double best = kBeyondTheWay;  // shares of the way; descend leaves out what is no nearer
    uint32_t found = kNothing;
    descend(
        nodes_, [&](const Node& node) { return share_to_box(way, node.low, node.high); }, best,
        [&](uint32_t i) {
            const double share = is_shown_[i] ? share_to_triangle(way, triangles_[i]) : kBeyondTheWay;
            if (share < best) {
                best = share;
                found = i;
            }
            return best <= enough;
        });
    if (found == kNothing) return {};
    return {original_[found], best * glm::length(way.along)};
}

TriangleHit TriangleTree::first_on_way(const glm::dvec3& from, const glm::dvec3& to) const {
    return on_way(from, to, 0.0);
}

bool TriangleTree::is_on_way(const glm::dvec3& from, const glm::dvec3& to) const {
    return on_way(from, to, 1.0).triangle != kNothing;
}

TriangleHit TriangleTree::cover(const Triangle& corners, double enough_m, uint32_t hint) const {
    return cover_below(corners, enough_m * enough_m, std::numeric_limits<double>::infinity(), hint);
}

TriangleHit TriangleTree::cover_within(const Triangle& corners, double limit_m, uint32_t hint) const {
    const double limit2 = limit_m * limit_m;
    const double above2 = std::nextafter(limit2, std::numeric_limits<double>::infinity());
    return cover_below(corners, limit2, above2, hint);
}

/// The best with a square below `below2`; stops at one that is at most `enough2`.
TriangleHit TriangleTree::cover_below(const Triangle& corners, double enough2, double below2,
                                      uint32_t hint) const {
    if (is_empty()) return {};
    double best2 = below2;
    uint32_t found = kNothing;
    const auto visit = [&](uint32_t i) {
        if (!is_shown_[i]) return false;
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
        // A triangle is no longer than the one that spans it, but for the limit at either end.
        const double longest_m = longest_edge_m(corners) * (1.0 - 1e-12);
        const auto box_distance2 = [&](const Node& node) {
            const double over_m = 0.5 * (longest_m - node.longest_m);
            if (over_m > 0.0 && over_m * over_m >= best2) return std::numeric_limits<double>::infinity();
            double farthest2 = squared_distance_to_box(corners.a, node.low, node.high);
            for (const glm::dvec3* corner : {&corners.b, &corners.c}) {
                if (farthest2 >= best2) return farthest2;
                farthest2 = std::max(farthest2, squared_distance_to_box(*corner, node.low, node.high));
            }
            return farthest2;
        };
        descend(nodes_, box_distance2, best2, visit);
    }
    if (found == kNothing) return {};
    return {original_[found], std::sqrt(best2)};
}

}  // namespace lod
