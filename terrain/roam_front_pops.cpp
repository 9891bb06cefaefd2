// What is seen to jump: vertices that appear or go without a glide, and diagonals that change at the raster's border.
#include <algorithm>

#include "terrain/corner_shift.h"
#include "terrain/displacement.h"
#include "terrain/roam_front.h"

namespace terrain {
namespace {

double cross(GridPoint from, GridPoint a, GridPoint b) {
    return double(a.x - from.x) * double(b.y - from.y) - double(b.x - from.x) * double(a.y - from.y);
}

/// Where a vertex off its edge gives the quadrangle around it another diagonal, the surface jumps, farthest at the
/// crossing of the edge that goes and the edge that comes, which leads across it to the other apex.
struct DiagonalGap {
    glm::vec3 crossing_m{0.0f}, way_m{0.0f};
};

/// @param grid   the edge's ends, the other apex, the vertex
/// @param place  the same in metres, as shown
DiagonalGap diagonal_gap(const std::array<GridPoint, 4>& grid, const std::array<glm::vec3, 4>& place) {
    const auto [from, to, apex, vertex] = grid;
    const double left = cross(from, to, vertex), right = cross(from, to, apex);
    const double before = cross(vertex, apex, from), after = cross(vertex, apex, to);
    if (left == right || before == after) return {place[3], glm::vec3(0.0f)};
    const auto along = static_cast<float>(left / (left - right));
    const auto across = static_cast<float>(before / (before - after));
    const glm::vec3 crossing = glm::mix(place[0], place[1], across);
    return {crossing, glm::mix(place[3], place[2], along) - crossing};
}

}  // namespace

/// Whether any eye saw, in the last frame, a triangle that a candidate's split will cut, where it was shown then. A
/// triangle that has come in this frame is as good as what it came from.
bool RoamFront::was_seen(DiamondIndex candidate) const {
    const auto [from, to] = mesh_.edge_ends(candidate);
    const auto then_m = [this](DiamondIndex corner) {
        const VertexGlide* glide = glides_.find(corner, mesh_[corner].level);
        return bound(corner).centre + (glide != nullptr ? glide->before_m : glm::vec3(0.0f));
    };
    for (const DiamondIndex apex : mesh_[candidate].parents()) {
        if (!is_record(apex) || has_come_unseen_[apex]) continue;
        const std::array<glm::vec3, 3> corners{then_m(apex), then_m(from), then_m(to)};
        for (const AnchoredEye& eye : odometer_.eyes_before()) {
            if (is_in_view(eye, corners)) return true;
        }
    }
    return false;
}

/// Lets a vertex come that has just been split in: gliding where somebody watches, at once where nobody can tell.
void RoamFront::let_come(DiamondIndex index, bool is_watched) {
    if (is_cut_) return;
    has_come_unseen_.set(index, !is_watched);
    if (!is_watched || bucket_of(index) <= kFlatBucket) return;
    if (!is_gliding(index) || !start_glide(index, false)) return note_pop(index);
    set_out_px_ = std::max(set_out_px_, double(scale_.upper_px(bucket_of(index))));
}

/// A vertex that appears or goes at once, in sight and not in a cut, moves the surface by as far as it is from its
/// edge. Where its kin does so in the same frame the surface was and is as wrong as the coarsest of them may be.
void RoamFront::note_pop(DiamondIndex index) {
    if (is_cut_ || bucket_of(index) <= kFlatBucket) return;
    const double error_px = static_cast<double>(scale_.upper_px(bucket_of(index)));
    most_popped_px_ = std::max(most_popped_px_, error_px);
    const bool is_alone = !has_popped_kin(index);
    has_popped_.set(index, true);
    const double most_px = 2.0 * (is_alone ? error_px : most_popped_px_);
    if (most_px <= popped_px_) return;
    GlideBase base;
    double way_px = most_px;
    if (is_alone && find_base(index, base)) {
        way_px = shift_px(index, base_from_place_m(base, index));
        if (base.shares[2] > 0.0f)
            way_px = std::max(way_px, diagonals_apart_px(index, base, bound(index).centre));
    }
    popped_px_ = std::max(popped_px_, std::min(way_px, most_px));
}

bool RoamFront::has_popped_kin(DiamondIndex index) const {
    const auto has_popped = [this](DiamondIndex kin) { return is_record(kin) && has_popped_[kin]; };
    const Diamond& d = mesh_[index];
    bool any = has_popped(d.parent0) || has_popped(d.parent1);
    for (int side = 0; side < 4; ++side)
        any = any || has_popped(mesh_.child(index, side));
    return any;
}

void RoamFront::forget_pops() {
    has_popped_.clear();
    has_come_unseen_.clear();
    most_popped_px_ = popped_px_ = 0.0;
}

/// @param vertex_m  where the vertex is shown
double RoamFront::diagonals_apart_px(DiamondIndex index, const GlideBase& base,
                                     const glm::vec3& vertex_m) const {
    const Diamond& d = mesh_[index];
    const DiamondIndex apex = d.parent0 == base.ends[2] ? d.parent1 : d.parent0;
    if (!is_record(apex)) return 0.0;
    std::array<GridPoint, 4> grid;
    std::array<glm::vec3, 4> place;
    const std::array<DiamondIndex, 4> corners{base.ends[0], base.ends[1], apex, index};
    for (size_t i = 0; i < 4; ++i) {
        grid[i] = table_.domain.clamped(mesh_[corners[i]].centre());
        place[i] = bound(corners[i]).centre + glides_.displacement_m(corners[i], mesh_[corners[i]].level);
    }
    place[3] = vertex_m;
    // The gap falls in straight lines from the crossing to nothing around the quadrangle.
    const DiagonalGap gap = diagonal_gap(grid, place);
    double worst_px = 0.0;
    for (const std::array<size_t, 2> side : {std::array<size_t, 2>{0, 2}, {2, 1}, {1, 3}, {3, 0}}) {
        worst_px = std::max(
            worst_px,
            corner_shift_px(odometer_.eyes(), {gap.crossing_m, place[side[0]], place[side[1]]}, gap.way_m));
    }
    return worst_px;
}

/// A vertex off its edge, at the raster's border, glides too, but the quadrangle's diagonal changes at once.
void RoamFront::note_flip(const VertexGlide& glide) {
    if (glide.base.shares[2] == 0.0f) return;
    const glm::vec3 at = bound(glide.index).centre + glide.shown_m;
    popped_px_ = std::max(popped_px_, diagonals_apart_px(glide.index, glide.base, at));
}

}  // namespace terrain
