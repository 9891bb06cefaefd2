#include "objects/alive_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "lod/base/check.h"

namespace objects {

namespace {

constexpr uint32_t kLeafPoints = 8;

double squared_distance_to_box(const PlaceAndTime& p, const PlaceAndTime& low, const PlaceAndTime& high) {
    double sum = 0.0;
    for (size_t k = 0; k < p.size(); ++k) {
        const double outside = std::max({low[k] - p[k], p[k] - high[k], 0.0});
        sum += outside * outside;
    }
    return sum;
}

}  // namespace

AliveTree::AliveTree(std::span<const PlaceAndTime> points) : original_(points.size()) {
    std::iota(original_.begin(), original_.end(), 0u);
    if (!points.empty()) split(points, 0, static_cast<uint32_t>(points.size()));
    place_.resize(points.size());
    points_.resize(points.size());
    is_alive_.assign(points.size(), 1);
    for (uint32_t i = 0; i < original_.size(); ++i) {
        place_[original_[i]] = i;
        points_[i] = points[original_[i]];
    }
}

uint32_t AliveTree::split(std::span<const PlaceAndTime> points, uint32_t begin, uint32_t end) {
    const uint32_t id = static_cast<uint32_t>(nodes_.size());
    Node node;
    node.begin = begin;
    node.end = end;
    node.alive = end - begin;
    node.low.fill(std::numeric_limits<double>::infinity());
    node.high.fill(-std::numeric_limits<double>::infinity());
    for (uint32_t i = begin; i < end; ++i) {
        for (size_t k = 0; k < node.low.size(); ++k) {
            node.low[k] = std::min(node.low[k], points[original_[i]][k]);
            node.high[k] = std::max(node.high[k], points[original_[i]][k]);
        }
    }
    nodes_.push_back(node);
    if (end - begin <= kLeafPoints) return id;
    size_t axis = 0;
    for (size_t k = 1; k < node.low.size(); ++k) {
        if (node.high[k] - node.low[k] > node.high[axis] - node.low[axis]) axis = k;
    }
    const uint32_t middle = begin + (end - begin) / 2;
    const auto first = original_.begin();
    std::nth_element(first + begin, first + middle, first + end, [&](uint32_t a, uint32_t b) {
        return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
    });
    split(points, begin, middle);
    const uint32_t right = split(points, middle, end);
    nodes_[id].right = right;
    return id;
}

void AliveTree::remove(uint32_t point) {
    const uint32_t place = place_[point];
    CHECK(is_alive_[place] != 0);
    is_alive_[place] = 0;
    for (uint32_t id = 0;;) {
        --nodes_[id].alive;
        if (nodes_[id].right == 0) return;
        id = place < nodes_[nodes_[id].right].begin ? id + 1 : nodes_[id].right;
    }
}

size_t AliveTree::nearest(uint32_t point, double radius, size_t most, std::vector<uint32_t>& out) const {
    out.clear();
    if (nodes_.empty() || most == 0) return 0;
    size_t visited = 0;
    const PlaceAndTime& centre = points_[place_[point]];
    using Found = std::pair<double, uint32_t>;  // square, original index
    std::vector<Found> found;                   // a heap, farthest first
    found.reserve(most + 1);
    const auto limit2 = [&] { return found.size() < most ? radius * radius : found.front().first; };
    std::vector<std::pair<uint32_t, double>> stack = {{0u, 0.0}};
    while (!stack.empty()) {
        const auto [id, distance2] = stack.back();
        stack.pop_back();
        ++visited;
        const Node& node = nodes_[id];
        if (node.alive == 0 || distance2 > limit2()) continue;
        if (node.right != 0) {
            const Node& left = nodes_[id + 1];
            const Node& right = nodes_[node.right];
            const double left2 = squared_distance_to_box(centre, left.low, left.high);
            const double right2 = squared_distance_to_box(centre, right.low, right.high);
            const std::pair<uint32_t, double> both[2] = {{id + 1, left2}, {node.right, right2}};
            stack.push_back(both[left2 <= right2 ? 1 : 0]);
            stack.push_back(both[left2 <= right2 ? 0 : 1]);
            continue;
        }
        for (uint32_t i = node.begin; i < node.end; ++i) {
            if (is_alive_[i] == 0 || original_[i] == point) continue;
            const Found one{squared_distance_to_box(centre, points_[i], points_[i]), original_[i]};
            if (one.first > radius * radius) continue;
            if (found.size() == most && !(one < found.front())) continue;
            found.push_back(one);
            std::push_heap(found.begin(), found.end());
            if (found.size() > most) {
                std::pop_heap(found.begin(), found.end());
                found.pop_back();
            }
        }
    }
    std::sort_heap(found.begin(), found.end());
    for (const Found& one : found)
        out.push_back(one.second);
    return visited;
}

}  // namespace objects
