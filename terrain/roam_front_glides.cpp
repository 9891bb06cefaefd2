// Gliding: new vertices glide in, superfluous ones glide out before they are merged, and what still jumps is told.
#include <algorithm>
#include <cmath>

#include "terrain/corner_shift.h"
#include "terrain/displacement.h"
#include "terrain/gliding_triangle.h"
#include "terrain/roam_front.h"
#include "terrain/vertex_star.h"

namespace terrain {
namespace {

double cross(GridPoint from, GridPoint a, GridPoint b) {
    return double(a.x - from.x) * double(b.y - from.y) - double(b.x - from.x) * double(a.y - from.y);
}

/// Shares of a triangle's corners in a point; false when it lies outside, or the triangle is none.
bool shares_in(GridPoint point, const std::array<GridPoint, 3>& corners, std::array<float, 3>& shares) {
    const double area = cross(corners[0], corners[1], corners[2]);
    if (area == 0.0) return false;
    for (size_t i = 0; i < 3; ++i) {
        const double share = cross(point, corners[(i + 1) % 3], corners[(i + 2) % 3]) / area;
        if (share < 0.0) return false;
        shares[i] = static_cast<float>(share);
    }
    return true;
}

}  // namespace

/// Where a vertex lies on the mesh without it: in the middle of its edge. At a border, where vertices are clamped, it
/// may be off its edge, inside one of the two triangles. False where it is in neither.
bool RoamFront::find_base(DiamondIndex index, GlideBase& base) const {
    const Domain& domain = table_.domain;
    const std::array<DiamondIndex, 2> edge = mesh_.edge_ends(index);
    const auto place = [&](DiamondIndex of) { return domain.clamped(mesh_[of].centre()); };
    const GridPoint at = place(index), from = place(edge[0]), to = place(edge[1]);
    base.ends = {edge[0], edge[1], edge[0]};
    base.shares = {0.5f, 0.5f, 0.0f};
    bool is_found = from.x + to.x == 2 * at.x && from.y + to.y == 2 * at.y;
    for (uint32_t which = 0; which < 2 && !is_found; ++which) {
        const DiamondIndex apex = mesh_[index].parent(which);
        if (!is_record(apex)) continue;
        base.ends[2] = apex;
        is_found = shares_in(at, {from, to, place(apex)}, base.shares);
    }
    for (size_t end = 0; end < 3; ++end)
        base.levels[end] = static_cast<uint8_t>(mesh_[base.ends[end]].level);
    return is_found;
}

/// Sends a vertex from where it was born to its place, or back; false where it cannot go.
bool RoamFront::start_glide(DiamondIndex index, bool leaves) {
    VertexGlide glide;
    glide.index = index;
    if (!find_base(index, glide.base)) return false;
    glide.base_from_place_m = base_from_place_m(glide.base, index);
    const VertexGlide& started = glides_.start(glide, mesh_[index].level, leaves, now_s_);
    if (!leaves) note_flip(started);
    return true;
}

/// Where a vertex's base is shown, seen from its place.
glm::vec3 RoamFront::base_from_place_m(const GlideBase& base, DiamondIndex index) const {
    glm::vec3 way = -bound(index).centre;
    for (size_t end = 0; end < 3; ++end)
        way += base.shares[end] * bound(base.ends[end]).centre;
    return way;
}

/// A diamond's sphere as it is shown: its corners may be under way.
DiamondBound RoamFront::shown_bound(DiamondIndex index) const {
    constexpr float kSmallShare = 0.05f;  // of the radius: not worth asking every corner
    DiamondBound shown = bound(index);
    float farthest_m = glides_.farthest_m();
    if (farthest_m > kSmallShare * shown.radius_m) {
        const auto [from, to] = mesh_.edge_ends(index);
        farthest_m = glm::length(glides_.displacement_m(index, mesh_[index].level));
        const auto [apex, opposite] = mesh_[index].parents();
        for (const DiamondIndex corner : {from, to, apex, opposite}) {
            if (!is_record(corner)) continue;
            const glm::vec3 way = glides_.displacement_m(corner, mesh_[corner].level);
            farthest_m = std::max(farthest_m, glm::length(way));
        }
    }
    shown.radius_m += farthest_m;
    return shown;
}

/// Pixels that a movement of a split diamond's vertex costs, on the triangles of the mesh at that vertex as they are
/// shown.
double RoamFront::shift_px(DiamondIndex index, const glm::vec3& way_m) const {
    double worst_px = 0.0;
    visit_star(mesh_, index, [&](const BintreeTriangle& triangle) {
        worst_px = std::max(worst_px, shift_px(index, triangle, way_m));
    });
    return worst_px;
}

/// … on one triangle.
double RoamFront::shift_px(DiamondIndex index, const BintreeTriangle& triangle,
                           const glm::vec3& way_m) const {
    std::array<glm::vec3, 3> corners{shown_m(index)};
    size_t count = 1;
    for (const DiamondIndex corner : {triangle.apex, triangle.left, triangle.right}) {
        if (corner != index) corners[count++] = shown_m(corner);
    }
    return corner_shift_px(odometer_.eyes(), corners, way_m);
}

/// Triangles of the mesh that hang on a diamond's split.
uint32_t RoamFront::parents_of(DiamondIndex index) const {
    const std::array<DiamondIndex, 2> parents = mesh_[index].parents();
    return uint32_t(is_record(parents[0])) + uint32_t(is_record(parents[1]));
}

/// Triangles that merging this diamond takes away.
uint64_t RoamFront::triangles_of(DiamondIndex index) const {
    return is_idle(index) ? 0 : uint64_t{parents_of(index)} << (2 * options_.batch);
}

/// Sends a mergeable diamond's vertex back to its edge; false when it must jump.
bool RoamFront::leave(DiamondIndex index) {
    if (!is_gliding(index) || !start_glide(index, true)) return false;
    unlink(index);
    enqueue(index, Queue::kLeave);
    leaving_triangles_ += triangles_of(index);
    return true;
}

/// It is wanted after all.
void RoamFront::stay(DiamondIndex index) {
    glides_.turn_round(index, mesh_[index].level, false, now_s_);
    leaving_triangles_ -= triangles_of(index);
}

/// Moves what is under way to where it is now; merges what is back on its edge. In a cut everything is there at
/// once.
void RoamFront::advance_glides(bool is_cut) {
    is_cut_ = is_cut;
    forget_pops();
    glided_px_ = glide_px_ = unglided_px_ = set_out_px_ = 0.0;
    if (is_cut) {
        edited_px_ = 0.0;
        for (int level = 0; level <= table_.domain.finest_level(); ++level) {
            for (const VertexGlide& glide : glides_.at_level(level))
                tessellator_.add_vertex(glide.index);
        }
        glides_.clear();
        back_.clear();
        BucketQueue& leaves = queue_at(Queue::kLeave);
        while (!leaves.is_empty()) {
            const DiamondIndex index = leaves.head(leaves.lowest());
            leaving_triangles_ -= triangles_of(index);
            unlink(index);
            enqueue(index, Queue::kMerge);
        }
        return;
    }
    glides_.advance(now_s_, back_);
    measure_steps();
    for (DiamondIndex index : back_) {
        note_flip(*glides_.find(index, mesh_[index].level));
        leaving_triangles_ -= triangles_of(index);
        merge_one(index);
        ++operations_[lod::OperationKind::kMerge];
    }
}

/// By how far vertices have moved since the last frame. A bound over a diamond's sphere is known at once; the triangles
/// at the vertex are asked where that might matter.
void RoamFront::measure_steps() {
    for (int level = 0; level <= table_.domain.finest_level(); ++level) {
        for (const VertexGlide& glide : glides_.at_level(level)) {
            tessellator_.add_vertex(glide.index);
            const glm::vec3 step_m = glide.shown_m - glide.before_m;
            const double step_px = displacement_px(odometer_.eyes(), shown_bound(glide.index), step_m);
            if (step_px > glided_px_) glided_px_ = std::max(glided_px_, shift_px(glide.index, step_m));
        }
    }
}

/// How far the surface is off where vertices are under way: at once for those that glide alone, then around the others.
void RoamFront::measure_glides() {
    glide_px_ = 0.0;
    unglided_px_ = mesh_error_px();
    together_.clear();
    for (int level = 0; level <= table_.domain.finest_level(); ++level) {
        for (VertexGlide& glide : glides_.at_level(level)) {
            const DiamondBound around = shown_bound(glide.index);
            glide.error_px = float(sphere_error_px(odometer_.eyes(), around));
            glide.way_px = float(displacement_px(odometer_.eyes(), around, glide.shown_m));
            if (!glides_alone(glide)) {
                together_.push_back(&glide);
                continue;
            }
            const double weight = double(glide.weight);
            glide_px_ = std::max(glide_px_, (1.0 - weight) * unglided_px_ + weight * double(glide.error_px));
        }
    }
    for (const VertexGlide* glide : together_) {
        // None of its triangles has a corner with a longer way, or it is met there.
        if (unglided_px_ + 3.0 * double(glide->way_px) > glide_px_) measure_around(glide->index);
    }
}

/// Whether its diamond's corners are at their places, and so is all that was split after it: then it is never farther off
/// than with it and without.
bool RoamFront::glides_alone(const VertexGlide& glide) const {
    if (!glide.base.is_middle() || mesh_[glide.index].split_kids > 0) return false;
    const auto [apex, opposite] = mesh_[glide.index].parents();
    for (const DiamondIndex corner : {glide.base.ends[0], glide.base.ends[1], apex, opposite}) {
        if (is_record(corner) && glides_.find(corner, mesh_[corner].level) != nullptr) return false;
    }
    return true;
}

/// The triangles at a vertex: by spheres first, exactly where that might matter.
void RoamFront::measure_around(DiamondIndex index) {
    const auto by_sphere = [](const VertexGlide& glide, const BintreeTriangle&) {
        return double(glide.way_px);
    };
    const auto by_corners = [this](const VertexGlide& glide, const BintreeTriangle& t) {
        return shift_px(glide.index, t, glide.shown_m);
    };
    visit_star(mesh_, index, [&](const BintreeTriangle& t) {
        if (gliding_error_px(mesh_, glides_, t, unglided_px_, by_sphere) <= glide_px_) return;
        glide_px_ = std::max(glide_px_, gliding_error_px(mesh_, glides_, t, unglided_px_, by_corners));
    });
}

}  // namespace terrain
