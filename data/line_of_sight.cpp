#include "data/line_of_sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "data/ground_height.h"
#include "lod/base/check.h"
#include "lod/base/parallel.h"

namespace data {
namespace {

constexpr double kTouch_m = 1e-6;     // less below the ground is on it
constexpr double kDecide_m = 1e-7;    // a part this near to a straight one is one
constexpr double kShortest_m = 1e-3;  // of the world that is looked at: between, over a pole, longitude jumps
constexpr double kShortestPart = 1e-12;

/// Part of a piece and its ends; x: column, y: row, z: height.
struct Part {
    double s0 = -1.0, s1 = 1.0;
    glm::dvec3 p0{0.0}, p1{0.0};
};

/// Fractions of something.
struct Stretch {
    double begin = 0.0, end = 1.0;
};

/// The stretch of a segment inside the rectangle [0, last]; nothing when begin > end.
Stretch clip_to(const glm::dvec2& last, const glm::dvec3& from, const glm::dvec3& to) {
    Stretch clip;
    for (int axis = 0; axis < 2; ++axis) {
        const double at = from[axis], way = to[axis] - from[axis];
        if (way == 0.0) {
            if (at < 0.0 || at > last[axis]) clip.end = -1.0;
            continue;
        }
        const double zero = -at / way, full = (last[axis] - at) / way;
        clip.begin = std::max(clip.begin, std::min(zero, full));
        clip.end = std::min(clip.end, std::max(zero, full));
    }
    return clip;
}

/// No point of the line's stretch is lower: the Earth lies within the sphere around its equator.
double lowest_possible_m(const WorldLine& line, const Stretch& share) {
    constexpr double kEquator_m = 6378137.0;
    const glm::dvec3 from = glm::mix(line.from, line.to, share.begin),
                     to = glm::mix(line.from, line.to, share.end);
    const double way2 = glm::dot(to - from, to - from);
    const double nearest = way2 > 0.0 ? std::clamp(glm::dot(-from, to - from) / way2, 0.0, 1.0) : 0.0;
    return glm::length(glm::mix(from, to, nearest)) - kEquator_m - 1e-3;
}

/// One line while it is looked along.
class Look {
  public:
    Look(const HeightGrid& grid, const HeightPyramid& pyramid, const WorldLine& line, bool is_backwards)
        : grid_(grid),
          pyramid_(pyramid),
          line_(line),
          is_backwards_(is_backwards),
          last_(grid.width - 1, grid.height - 1),
          cell_m_(std::max(grid.frame.cell_m().x, grid.frame.cell_m().y)),
          highest_m_(double(pyramid.levels[0].max_m[0])) {}

    /// The nearest blocked place of a stretch, as a share of the line.
    std::optional<double> first_blocked(const Stretch& share) {
        if (grid_.frame.world().has_datum && lowest_possible_m(line_, share) > highest_m_)
            return std::nullopt;
        TrackPiece piece;
        piece.begin = share.begin;
        piece.end = share.end;
        const TrackFit fit = fit_track(grid_.frame, line_, piece);
        if (fit == TrackFit::kNowhere) return std::nullopt;
        if (fit == TrackFit::kGood) return along(piece);
        if (glm::distance(line_.from, line_.to) * (share.end - share.begin) < kShortest_m)
            return std::nullopt;
        const double middle = 0.5 * (share.begin + share.end);
        const Stretch low{share.begin, middle}, high{middle, share.end};
        const auto nearer = first_blocked(is_backwards_ ? high : low);
        return nearer ? nearer : first_blocked(is_backwards_ ? low : high);
    }

    bool is_through_void() const { return is_through_void_; }

  private:
    enum class Verdict : uint8_t { kClear, kBlocked, kUnsure };

    /// Where a piece is blocked first.
    std::optional<double> along(const TrackPiece& piece) {
        piece_ = &piece;
        const glm::dvec2 turn = grid_.frame.full_turn_cells();
        std::optional<double> first;
        for (int turns = -1; turns <= 1; ++turns) {
            shift_ = glm::dvec3(turn * double(turns), 0.0);
            if (turns != 0 && turn == glm::dvec2(0.0)) continue;
            if (visit({-1.0, 1.0, at(-1.0), at(1.0)}) && (!first || is_nearer(blocked_at_, *first)))
                first = blocked_at_;
        }
        return first ? std::optional<double>(piece.share_at(*first)) : std::nullopt;
    }

    glm::dvec3 at(double s) const { return piece_->at(s) + shift_; }
    bool is_nearer(double s, double than) const { return is_backwards_ ? s > than : s < than; }

    /// True when the part is blocked; then blocked_at_ is where first.
    bool visit(const Part& part) {
        const double width = part.s1 - part.s0;
        const glm::dvec3 off =
            piece_->bend * (width * width / 8.0);  // from the straight line between the ends
        const glm::dvec3 min = glm::min(part.p0, part.p1) - off, max = glm::max(part.p0, part.p1) + off;
        if (min.z + kTouch_m > double(highest_m(pyramid_, glm::dvec2(min), glm::dvec2(max)))) return false;
        const bool is_shortest = width < kShortestPart;
        if (max.x - min.x <= 1.0 && max.y - min.y <= 1.0) {
            const Verdict verdict = look_closely(part, off, is_shortest);
            if (verdict != Verdict::kUnsure) return verdict == Verdict::kBlocked;
        } else if (is_shortest) {
            return false;
        }
        const double middle = 0.5 * (part.s0 + part.s1);
        const glm::dvec3 p = at(middle);
        const Part low{part.s0, middle, part.p0, p}, high{middle, part.s1, p, part.p1};
        return is_backwards_ ? visit(high) || visit(low) : visit(low) || visit(high);
    }

    /// A part over a handful of triangles, nearly straight.
    Verdict look_closely(const Part& part, const glm::dvec3& off, bool is_last) {
        const glm::dvec2 min = glm::dvec2(glm::min(part.p0, part.p1) - off),
                         max = glm::dvec2(glm::max(part.p0, part.p1) + off);
        const glm::dvec2 range = height_range(min, max);
        if (std::min(part.p0.z, part.p1.z) - off.z + kTouch_m > range.y) return Verdict::kClear;
        // Sideways by a cell changes the ground's height by no more than the range.
        const double doubt_m = off.z + (off.x + off.y) * (range.y - range.x + cell_m_);
        const bool is_sure = is_last || doubt_m <= kDecide_m;
        const bool is_all_inside = min.x >= 0.0 && min.y >= 0.0 && max.x <= last_.x && max.y <= last_.y;
        const Stretch clip = clip_to(last_, part.p0, part.p1);
        if (clip.begin > clip.end) return is_sure ? Verdict::kClear : Verdict::kUnsure;

        cut(part, clip);
        double lowest_m = above_[0];
        for (double above_m : above_)
            lowest_m = std::min(lowest_m, above_m);
        if (lowest_m >= 0.0 && is_sure) return Verdict::kClear;
        if (lowest_m > doubt_m && is_all_inside) return Verdict::kClear;
        return is_sure ? decide(part) : Verdict::kUnsure;
    }

    /// Lowest and highest sample of the cells that a rectangle touches.
    glm::dvec2 height_range(const glm::dvec2& min, const glm::dvec2& max) const {
        const auto first = glm::ivec2(glm::clamp(glm::floor(min), glm::dvec2(0.0), last_));
        const auto last = glm::ivec2(glm::clamp(glm::ceil(max), glm::dvec2(0.0), last_));
        float low = grid_.at(first.x, first.y), high = low;
        for (int row = first.y; row <= last.y; ++row) {
            for (int col = first.x; col <= last.x; ++col) {
                low = std::min(low, grid_.at(col, row));
                high = std::max(high, grid_.at(col, row));
            }
        }
        return {low, high};
    }

    glm::dvec3 place(const Part& part, double fraction) const { return glm::mix(part.p0, part.p1, fraction); }

    double ground_m(const glm::dvec3& p) const {
        return ground_height(grid_, std::clamp(p.x, 0.0, last_.x), std::clamp(p.y, 0.0, last_.y)).height_m;
    }

    /// Fills cuts_ with the fractions where the straight part crosses edges, and above_ with its heights there.
    void cut(const Part& part, const Stretch& clip) {
        mesh_crossings(glm::dvec2(part.p0), glm::dvec2(part.p1), crossings_);
        cuts_.assign(1, clip.begin);
        for (double fraction : crossings_) {
            if (fraction > clip.begin && fraction < clip.end) cuts_.push_back(fraction);
        }
        cuts_.push_back(clip.end);
        above_.clear();
        for (double fraction : cuts_) {
            const glm::dvec3 p = place(part, fraction);
            above_.push_back(p.z - ground_m(p) + kTouch_m);
        }
    }

    /// Along the cuts, in the direction of the look.
    Verdict decide(const Part& part) {
        const size_t count = cuts_.size() - 1;
        for (size_t i = 0; i < count; ++i) {
            const size_t low = is_backwards_ ? count - 1 - i : i;
            const size_t near = is_backwards_ ? low + 1 : low, far = is_backwards_ ? low : low + 1;
            if (above_[near] >= 0.0 && above_[far] >= 0.0) continue;
            const glm::dvec3 middle = place(part, 0.5 * (cuts_[near] + cuts_[far]));
            if (!ground_height(grid_, std::clamp(middle.x, 0.0, last_.x), std::clamp(middle.y, 0.0, last_.y))
                     .valid) {
                is_through_void_ = true;
                continue;
            }
            const double way = above_[near] < 0.0 ? 0.0 : above_[near] / (above_[near] - above_[far]);
            const double fraction = cuts_[near] + (cuts_[far] - cuts_[near]) * way;
            blocked_at_ = part.s0 + (part.s1 - part.s0) * fraction;
            return Verdict::kBlocked;
        }
        return Verdict::kClear;
    }

    const HeightGrid& grid_;
    const HeightPyramid& pyramid_;
    const WorldLine line_;
    const bool is_backwards_;
    const glm::dvec2 last_;
    const double cell_m_;
    const double highest_m_;
    const TrackPiece* piece_ = nullptr;
    glm::dvec3 shift_{0.0};
    double blocked_at_ = 0.0;
    bool is_through_void_ = false;
    std::vector<double> crossings_, cuts_, above_;  // scratch
};

/// A total order of points, so that a line and its reverse are cut alike.
bool is_before(const glm::dvec3& a, const glm::dvec3& b) {
    if (a.x != b.x) return a.x < b.x;
    return a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace

Sight line_of_sight(const HeightGrid& grid, const HeightPyramid& pyramid, const WorldLine& line) {
    DCHECK(pyramid.width == grid.width && pyramid.height == grid.height);
    const bool is_backwards = is_before(line.to, line.from);
    const WorldLine ordered = is_backwards ? WorldLine{line.to, line.from} : line;
    Look look(grid, pyramid, ordered, is_backwards);
    const std::optional<double> share = look.first_blocked({0.0, 1.0});
    Sight sight;
    sight.is_blocked = share.has_value();
    sight.is_through_void = look.is_through_void();
    if (share) sight.share = is_backwards ? 1.0 - *share : *share;
    sight.end_world = share ? glm::mix(ordered.from, ordered.to, *share) : line.to;
    return sight;
}

void lines_of_sight(const HeightGrid& grid, const HeightPyramid& pyramid, std::span<const WorldLine> lines,
                    std::span<Sight> out, unsigned threads) {
    CHECK(out.size() == lines.size());
    lod::parallel_for(lines.size(), threads, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            out[i] = line_of_sight(grid, pyramid, lines[i]);
    });
}

}  // namespace data
