#include "objects/reduction/contraction.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "lod/base/check.h"
#include "objects/reduction/close_points.h"
#include "objects/reduction/quadric.h"

namespace objects {

namespace {

constexpr uint32_t kNone = 0xffffffffu;
constexpr uint32_t kMostClosePairs = 8;  ///< a point; more are redundant, they grow together over others
constexpr size_t kMostFaces =
    512;  ///< around a pair; beyond it stays, so that no hub makes the work quadratic

/// Two points that may become one.
struct Pair {
    float rank = 0.0f;  ///< order of the work: cost, short pairs first
    bool is_edge = true;
    uint32_t a = 0, b = 0, age_a = 0, age_b = 0;
    double cost_m = 0.0;
    glm::dvec3 place{0.0};
};

struct IsLater {
    bool operator()(const Pair& p, const Pair& q) const {
        if (p.rank != q.rank) return p.rank > q.rank;
        return p.a != q.a ? p.a > q.a : p.b > q.b;
    }
};

/// Union-find over a fixed number of things.
class Groups {
  public:
    explicit Groups(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    uint32_t find(uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(uint32_t kept, uint32_t gone) { parent_[find(gone)] = find(kept); }

  private:
    std::vector<uint32_t> parent_;
};

class Contraction {
  public:
    Contraction(const FaceSoup& soup, const std::vector<double>& tolerance_m, const ContractionReach& reach)
        : reach_(reach),
          points_(soup.points),
          faces_(soup.faces),
          tolerance_m_(tolerance_m),
          quadrics_(points_.size()),
          age_(points_.size(), 0),
          is_dead_(faces_.size(), 0),
          first_corner_(points_.size(), kNone),
          last_corner_(points_.size(), kNone),
          next_corner_(3 * faces_.size(), kNone),
          points_groups_(points_.size()),
          parts_(points_.size()),
          faces_of_part_(points_.size(), 0) {
        CHECK(tolerance_m.size() == points_.size());
        for (uint32_t face = 0; face < faces_.size(); ++face)
            add_face(face);
        add_borders_and_edges();
        for (const auto& [a, b] : close_pairs(points_, reach.close_m, kMostClosePairs))
            offer(a, b, false);
    }

    void run() {
        while (!queue_.empty()) {
            Pair pair = queue_.top();
            queue_.pop();
            if (!refresh(pair)) continue;
            if (pair.cost_m > std::min(tolerance_m_[pair.a], tolerance_m_[pair.b])) continue;
            if (is_allowed(pair)) join(pair);
        }
    }

    FaceSoup result(const FaceSoup& soup) const {
        FaceSoup out;
        out.points = points_;
        for (uint32_t face = 0; face < faces_.size(); ++face) {
            if (is_dead_[face]) continue;
            out.faces.push_back(faces_[face]);
            out.colours.push_back(soup.colours[face]);
        }
        return out;
    }

  private:
    void add_face(uint32_t face);
    void add_borders_and_edges();
    void offer(uint32_t a, uint32_t b, bool is_edge);
    bool refresh(Pair& pair);
    bool is_allowed(const Pair& pair);
    bool turns_over(uint32_t point, uint32_t other, const glm::dvec3& place);
    void join(const Pair& pair);
    void gather_faces(uint32_t point, std::vector<uint32_t>& out);
    void drop_repeated(std::vector<uint32_t>& around);

    /// Visits the living faces of a point and unlinks the dead.
    template <typename Visit>
    void for_faces(uint32_t point, const Visit& visit) {
        uint32_t previous = kNone;
        for (uint32_t corner = first_corner_[point]; corner != kNone; corner = next_corner_[corner]) {
            if (is_dead_[corner / 3]) {
                (previous == kNone ? first_corner_[point] : next_corner_[previous]) = next_corner_[corner];
                if (last_corner_[point] == corner) last_corner_[point] = previous;
                continue;
            }
            previous = corner;
            visit(corner / 3);
        }
    }

    ContractionReach reach_;
    std::vector<glm::dvec3> points_;
    std::vector<std::array<uint32_t, 3>> faces_;
    std::vector<double> tolerance_m_;
    std::vector<Quadric> quadrics_;
    std::vector<uint32_t> age_;  ///< [points] how often it has changed
    std::vector<uint8_t> is_dead_;
    std::vector<uint32_t> first_corner_, last_corner_, next_corner_;  ///< faces of a point, as linked corners
    Groups points_groups_, parts_;
    std::vector<uint32_t> faces_of_part_;
    std::priority_queue<Pair, std::vector<Pair>, IsLater> queue_;
    std::vector<uint32_t> around_, neighbours_;  ///< scratch
};

void Contraction::add_face(uint32_t face) {
    const auto& corners = faces_[face];
    const glm::dvec3 a = points_[corners[0]], b = points_[corners[1]], c = points_[corners[2]];
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = std::sqrt(glm::dot(cross, cross));
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t point = corners[k], corner = 3 * face + k;
        (last_corner_[point] == kNone ? first_corner_[point] : next_corner_[last_corner_[point]]) = corner;
        last_corner_[point] = corner;
        // Large faces do not outvote small ones: beyond the tolerance's own size all count alike.
        const double most = 4.0 * tolerance_m_[point] * tolerance_m_[point];
        const glm::dvec3 normal = length > 0.0 ? cross / length : glm::dvec3(0.0);
        if (length > 0.0)
            quadrics_[point].add_plane(normal, -glm::dot(normal, a), std::min(0.5 * length, most) + 1e-12);
    }
    for (uint32_t k = 1; k < 3; ++k) {
        const uint32_t kept = parts_.find(corners[0]), gone = parts_.find(corners[k]);
        if (kept == gone) continue;
        faces_of_part_[kept] += faces_of_part_[gone];
        parts_.join(kept, gone);
    }
    ++faces_of_part_[parts_.find(corners[0])];
}

void Contraction::add_borders_and_edges() {
    struct Edge {
        uint32_t a, b, face;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * faces_.size());
    for (uint32_t face = 0; face < faces_.size(); ++face) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = faces_[face][k], b = faces_[face][(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), face});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& p, const Edge& q) {
        return p.a != q.a ? p.a < q.a : (p.b != q.b ? p.b < q.b : p.face < q.face);
    });
    // A border, an edge of one face only, is held by a plane that stands upright on it. Before any pair is judged.
    const auto is_same = [&](size_t i, size_t k) {
        return edges[i].a == edges[k].a && edges[i].b == edges[k].b;
    };
    for (size_t i = 0; i < edges.size(); ++i) {
        if ((i > 0 && is_same(i, i - 1)) || (i + 1 < edges.size() && is_same(i, i + 1))) continue;
        const auto& [a, b, face] = edges[i];
        const auto& corners = faces_[face];
        const glm::dvec3 along = points_[b] - points_[a];
        const glm::dvec3 up =
            glm::cross(points_[corners[1]] - points_[corners[0]], points_[corners[2]] - points_[corners[0]]);
        const glm::dvec3 cross = glm::cross(along, up);
        const double length = std::sqrt(glm::dot(cross, cross));
        if (!(length > 0.0)) continue;
        for (uint32_t point : {a, b}) {
            const double most = 4.0 * tolerance_m_[point] * tolerance_m_[point];
            const double weight = std::min(0.5 * glm::dot(along, along), most) + 1e-12;
            quadrics_[point].add_plane(cross / length, -glm::dot(cross, points_[a]) / length, weight);
        }
    }
    for (size_t i = 0; i < edges.size(); ++i) {
        if (i == 0 || !is_same(i, i - 1)) offer(edges[i].a, edges[i].b, true);
    }
}

/// Judges a pair and puts it into the queue unless it is hopeless.
void Contraction::offer(uint32_t a, uint32_t b, bool is_edge) {
    if (a > b) std::swap(a, b);
    const double length = glm::length(points_[a] - points_[b]);
    if (reach_.longest_m > 0.0 && length > reach_.longest_m) return;
    const glm::dvec3 middle = 0.5 * (points_[a] + points_[b]);
    Quadric both = quadrics_[a];
    both.add(quadrics_[b]);
    Pair pair;
    pair.cost_m = std::numeric_limits<double>::infinity();
    const auto consider = [&](const glm::dvec3& place) {
        const double square = std::max(quadrics_[a].mean_square(place), quadrics_[b].mean_square(place));
        if (!(square < pair.cost_m)) return;
        pair.cost_m = square;
        pair.place = place;
    };
    consider(points_[a]);
    consider(points_[b]);
    consider(middle);
    if (pair.cost_m > 0.0) consider(both.best_near(middle));
    pair.cost_m = std::sqrt(pair.cost_m);
    const double tolerance = std::min(tolerance_m_[a], tolerance_m_[b]);
    if (!(pair.cost_m <= tolerance)) return;
    pair.rank = static_cast<float>(pair.cost_m + 0.02 * length);
    pair.is_edge = is_edge;
    pair.a = a;
    pair.b = b;
    pair.age_a = age_[a];
    pair.age_b = age_[b];
    queue_.push(pair);
}

/// False for a pair whose points have changed since it was judged. Edges were judged anew then; pairs of close points
/// are now, for what their points have become.
bool Contraction::refresh(Pair& pair) {
    if (age_[pair.a] == pair.age_a && age_[pair.b] == pair.age_b) return true;
    if (pair.is_edge) return false;
    const uint32_t a = points_groups_.find(pair.a), b = points_groups_.find(pair.b);
    if (a != b && lod::squared_distance(points_[a], points_[b]) <= reach_.close_m * reach_.close_m)
        offer(a, b, false);
    return false;
}

void Contraction::gather_faces(uint32_t point, std::vector<uint32_t>& out) {
    for_faces(point, [&](uint32_t face) { out.push_back(face); });
}

bool Contraction::turns_over(uint32_t point, uint32_t other, const glm::dvec3& place) {
    bool turns = false;
    const double small = tolerance_m_[point] * tolerance_m_[point];
    for_faces(point, [&](uint32_t face) {
        std::array<glm::dvec3, 3> before, after;
        for (size_t k = 0; k < 3; ++k) {
            if (faces_[face][k] == other) return;  // goes
            before[k] = points_[faces_[face][k]];
            after[k] = faces_[face][k] == point ? place : before[k];
        }
        const glm::dvec3 old_cross = glm::cross(before[1] - before[0], before[2] - before[0]);
        if (glm::dot(old_cross, old_cross) <= small * small) return;
        if (glm::dot(old_cross, glm::cross(after[1] - after[0], after[2] - after[0])) < 0.0) turns = true;
    });
    return turns;
}

bool Contraction::is_allowed(const Pair& pair) {
    around_.clear();
    gather_faces(pair.a, around_);
    const size_t at_a = around_.size();
    gather_faces(pair.b, around_);
    if (around_.size() > kMostFaces) return false;
    size_t lost = 0;
    for (size_t i = 0; i < at_a; ++i) {
        const auto& corners = faces_[around_[i]];
        lost += std::find(corners.begin(), corners.end(), pair.b) != corners.end();
    }
    const uint32_t part_a = parts_.find(pair.a), part_b = parts_.find(pair.b);
    const uint32_t faces = faces_of_part_[part_a] + (part_a == part_b ? 0 : faces_of_part_[part_b]);
    if (lost >= faces) return false;
    return !turns_over(pair.a, pair.b, pair.place) && !turns_over(pair.b, pair.a, pair.place);
}

/// Of faces with the same corners one stays.
void Contraction::drop_repeated(std::vector<uint32_t>& around) {
    const auto key = [&](uint32_t face) {
        std::array<uint32_t, 3> corners = faces_[face];
        std::sort(corners.begin(), corners.end());
        return corners;
    };
    std::sort(around.begin(), around.end(),
              [&](uint32_t p, uint32_t q) { return key(p) != key(q) ? key(p) < key(q) : p < q; });
    for (size_t i = 1; i < around.size(); ++i) {
        if (key(around[i]) != key(around[i - 1])) continue;
        is_dead_[around[i]] = 1;
        --faces_of_part_[parts_.find(faces_[around[i]][0])];
    }
}

void Contraction::join(const Pair& pair) {
    const uint32_t kept = pair.a, gone = pair.b;
    const uint32_t part = parts_.find(kept), other_part = parts_.find(gone);
    if (part != other_part) {
        faces_of_part_[part] += faces_of_part_[other_part];
        parts_.join(part, other_part);
    }
    points_[kept] = pair.place;
    quadrics_[kept].add(quadrics_[gone]);
    tolerance_m_[kept] = std::min(tolerance_m_[kept], tolerance_m_[gone]);
    points_groups_.join(kept, gone);
    ++age_[kept];
    ++age_[gone];
    for_faces(gone, [&](uint32_t face) {
        auto& corners = faces_[face];
        if (std::find(corners.begin(), corners.end(), kept) != corners.end()) {
            is_dead_[face] = 1;
            --faces_of_part_[part];
        }
        std::replace(corners.begin(), corners.end(), gone, kept);
    });
    if (first_corner_[gone] != kNone) {
        (last_corner_[kept] == kNone ? first_corner_[kept] : next_corner_[last_corner_[kept]]) =
            first_corner_[gone];
        last_corner_[kept] = last_corner_[gone];
        first_corner_[gone] = last_corner_[gone] = kNone;
    }
    around_.clear();
    gather_faces(kept, around_);
    drop_repeated(around_);
    neighbours_.clear();
    for_faces(kept, [&](uint32_t face) {
        for (uint32_t corner : faces_[face]) {
            if (corner != kept) neighbours_.push_back(corner);
        }
    });
    std::sort(neighbours_.begin(), neighbours_.end());
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    for (uint32_t neighbour : neighbours_)
        offer(kept, neighbour, true);
}

}  // namespace

FaceSoup contract(const FaceSoup& soup, const std::vector<double>& tolerance_m,
                  const ContractionReach& reach) {
    Contraction contraction(soup, tolerance_m, reach);
    contraction.run();
    return contraction.result(soup);
}

}  // namespace objects
