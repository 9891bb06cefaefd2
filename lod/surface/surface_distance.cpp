#include "lod/surface/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lod/base/check.h"
#include "lod/base/parallel.h"

namespace lod {

namespace {

constexpr size_t kTrianglesPerTask = 256;  ///< fixed, so that the bounds do not depend on the threads
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr uint32_t kNoHint = 0xffffffffu;

/// A piece of a source triangle, and the target triangle that was best for the piece it came from.
struct Piece {
    Triangle corners;
    uint32_t hint = kNoHint;
};

/// Depth first, so what waits is one piece a bisection: two bisections or three halve a triangle.
class PieceStack {
  public:
    void start(const Triangle& triangle, uint32_t hint) {
        count_ = 0;
        push(triangle, hint);
    }
    Piece pop() {
        const Stored& top = pieces_[--count_];
        return {{top.a, top.b, top.c}, top.hint};
    }
    bool is_empty() const { return count_ == 0; }
    bool is_full() const { return count_ + 2 > pieces_.size(); }

    void push_halves(const Triangle& turned, const glm::dvec3& middle, uint32_t hint) {
        DCHECK(!is_full());
        push({turned.a, middle, turned.c}, hint);
        push({middle, turned.b, turned.c}, hint);
    }

  private:
    /// A piece that begins as anything: clearing them all took a fifth of a build's instructions.
    struct Stored {
        glm::dvec3 a, b, c;
        uint32_t hint;
    };
    void push(const Triangle& t, uint32_t hint) { pieces_[count_++] = {t.a, t.b, t.c, hint}; }

    std::array<Stored, 128> pieces_;
    size_t count_ = 0;
};

/// Tightens the bounds by one triangle of the source.
void bound_triangle(const Triangle& triangle, const TriangleTree& to, double slack_m, PieceStack& stack,
                    DistanceBounds& bounds) {
    stack.start(triangle, kNoHint);
    while (!stack.is_empty()) {
        const Piece piece = stack.pop();
        const Triangle turned = turn_longest_first(piece.corners);
        const TriangleHit hit = to.cover(turned, bounds.lower_m + slack_m, piece.hint);
        if (hit.distance_m > bounds.lower_m + slack_m && !stack.is_full()) {
            const glm::dvec3 middle = 0.5 * (turned.a + turned.b);
            for (const glm::dvec3& point : {turned.a, turned.b, turned.c, middle})
                bounds.lower_m = std::max(bounds.lower_m, to.nearest(point).distance_m);
            if (hit.distance_m > bounds.lower_m + slack_m) {
                stack.push_halves(turned, middle, hit.triangle);
                continue;
            }
        }
        bounds.upper_m = std::max(bounds.upper_m, hit.distance_m);
    }
}

bool is_beyond(const glm::dvec3& point, const TriangleTree& to, double limit_m) {
    return to.any_within(point, limit_m).distance_m > limit_m;
}

bool is_within(const Triangle& triangle, const TriangleTree& to, double limit_m, PieceStack& stack,
               PieceSearch& search) {
    if (to.is_empty()) return false;
    const double smallest_m = search.smallest_share * limit_m;
    stack.start(triangle, search.hint);
    uint32_t left = search.most_pieces;
    for (bool has_split = false; !stack.is_empty(); has_split = true) {
        const Piece piece = stack.pop();
        const Triangle turned = turn_longest_first(piece.corners);
        const TriangleHit hit = to.cover_within(turned, limit_m, piece.hint);
        if (hit.distance_m <= limit_m) {
            search.hint = hit.triangle;
            continue;
        }
        if (--left == 0 || stack.is_full()) return false;
        // The inside first: edges often lie on neighbours of what is missing.
        const glm::dvec3 inside = (turned.a + turned.b + turned.c) / 3.0;
        const TriangleHit near = to.any_within(inside, limit_m);
        if (near.distance_m > limit_m) return false;
        if (!has_split && (is_beyond(turned.a, to, limit_m) || is_beyond(turned.b, to, limit_m) ||
                           is_beyond(turned.c, to, limit_m)))
            return false;
        if (squared_distance(turned.a, turned.b) <= smallest_m * smallest_m) return false;
        stack.push_halves(turned, 0.5 * (turned.a + turned.b), near.triangle);
    }
    return true;
}

}  // namespace

DistanceBounds one_sided_distance(const Soup& from, const TriangleTree& to, double slack_m,
                                  unsigned threads) {
    CHECK(slack_m > 0.0);
    if (from.triangles.empty()) return {};
    if (to.is_empty()) return {kInfinity, kInfinity};
    const size_t tasks = (from.triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
    const auto for_tasks = [&](const auto& body) {
        parallel_for(tasks, threads, [&](size_t begin, size_t end) {
            for (size_t task = begin; task < end; ++task) {
                const size_t last = std::min((task + 1) * kTrianglesPerTask, from.triangles.size());
                body(task, task * kTrianglesPerTask, last);
            }
        });
    };
    // A good bound from below first: it lets most triangles pass unsplit.
    std::vector<DistanceBounds> found(tasks);
    for_tasks([&](size_t task, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const double distance = to.nearest(from.triangle(i).a).distance_m;
            found[task].lower_m = std::max(found[task].lower_m, distance);
        }
    });
    DistanceBounds total;
    for (const DistanceBounds& one : found)
        total.lower_m = std::max(total.lower_m, one.lower_m);
    for_tasks([&](size_t task, size_t begin, size_t end) {
        found[task] = total;
        PieceStack stack;
        for (size_t i = begin; i < end; ++i)
            bound_triangle(from.triangle(i), to, slack_m, stack, found[task]);
    });
    for (const DistanceBounds& one : found) {
        total.lower_m = std::max(total.lower_m, one.lower_m);
        total.upper_m = std::max(total.upper_m, one.upper_m);
    }
    total.upper_m = std::max(total.upper_m, total.lower_m);
    return total;
}

DistanceBounds two_sided_distance(const Soup& a, const Soup& b, double slack_m, unsigned threads) {
    const DistanceBounds there = one_sided_distance(a, TriangleTree(b), slack_m, threads);
    const DistanceBounds back = one_sided_distance(b, TriangleTree(a), slack_m, threads);
    return {std::max(there.lower_m, back.lower_m), std::max(there.upper_m, back.upper_m)};
}

bool is_within(const Triangle& triangle, const TriangleTree& to, double limit_m, PieceSearch& search) {
    PieceStack stack;
    return is_within(triangle, to, limit_m, stack, search);
}

void find_beyond(const Soup& from, const TriangleTree& to, double limit_m, std::vector<uint32_t>& out,
                 PieceSearch search) {
    PieceStack stack;
    for (uint32_t i = 0; i < from.triangles.size(); ++i) {
        if (!is_within(from.triangle(i), to, limit_m, stack, search)) out.push_back(i);
    }
}

}  // namespace lod
