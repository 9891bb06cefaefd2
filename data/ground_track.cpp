#include "data/ground_track.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace data {
namespace {

constexpr size_t kTerms = TrackPiece::kTerms;
constexpr double kGood_m = 1e-7, kGoodWithinCell_m = 1e-3;

/// Where the nodes are, and the polynomials there: [term][node], weighted so that sums over nodes are coefficients.
struct Nodes {
    std::array<double, kTerms> s;
    std::array<std::array<double, kTerms>, kTerms> weight;

    Nodes() {
        for (size_t node = 0; node < kTerms; ++node) {
            const double angle = (2.0 * double(node) + 1.0) * std::numbers::pi / (2.0 * double(kTerms));
            s[node] = std::cos(angle);
            for (size_t term = 0; term < kTerms; ++term) {
                weight[term][node] =
                    std::cos(double(term) * angle) * (term == 0 ? 1.0 : 2.0) / double(kTerms);
            }
        }
    }
};

const Nodes& nodes() {
    static const Nodes all;
    return all;
}

/// Longitudes jump where the turn begins anew: each node is taken to the turn of the one before.
void unwind(std::array<glm::dvec3, kTerms>& points, const glm::dvec2& turn) {
    const double turn2 = glm::dot(turn, turn);
    if (turn2 == 0.0) return;
    for (size_t i = 1; i < kTerms; ++i) {
        const glm::dvec2 step(points[i] - points[i - 1]);
        const glm::dvec2 back = turn * std::round(glm::dot(step, turn) / turn2);
        points[i] -= glm::dvec3(back, 0.0);
    }
}

bool is_somewhere(const glm::dvec3& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

}  // namespace

// Clenshaw's recurrence.
glm::dvec3 TrackPiece::at(double s) const {
    glm::dvec3 next(0.0), here(0.0);
    for (size_t k = kTerms - 1; k > 0; --k) {
        const glm::dvec3 before = terms[k] + 2.0 * s * here - next;
        next = here;
        here = before;
    }
    return terms[0] + s * here - next;
}

TrackFit fit_track(const GroundFrame& frame, const WorldLine& line, TrackPiece& out) {
    const Nodes& at = nodes();
    std::array<glm::dvec3, kTerms> points;
    for (size_t node = 0; node < kTerms; ++node)
        points[node] = glm::mix(line.from, line.to, out.share_at(at.s[node]));
    frame.grid_from_world(points);
    const auto somewhere = std::count_if(points.begin(), points.end(), is_somewhere);
    if (somewhere < int{kTerms}) return somewhere == 0 ? TrackFit::kNowhere : TrackFit::kTooLong;
    unwind(points, frame.full_turn_cells());

    out.bend = glm::dvec3(0.0);
    for (size_t term = 0; term < kTerms; ++term) {
        glm::dvec3& sum = out.terms[term] = glm::dvec3(0.0);
        for (size_t node = 0; node < kTerms; ++node)
            sum += points[node] * at.weight[term][node];
        const double k2 = double(term * term);
        out.bend += glm::abs(sum) * (k2 * (k2 - 1.0) / 3.0);  // |T_k''| <= k^2 (k^2 - 1) / 3, 0 up to k = 1
    }
    const glm::dvec3 last = glm::max(glm::abs(out.terms[kTerms - 2]), glm::abs(out.terms[kTerms - 1]));
    const glm::dvec2 cell = frame.cell_m();
    const double off_m = std::max({last.x * cell.x, last.y * cell.y, last.z});
    const double length_m = glm::distance(line.from, line.to) * (out.end - out.begin);
    const bool is_good =
        off_m <= kGood_m || (off_m <= kGoodWithinCell_m && length_m <= std::min(cell.x, cell.y));
    return is_good ? TrackFit::kGood : TrackFit::kTooLong;
}

}  // namespace data
