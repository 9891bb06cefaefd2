// SurfaceImage: where the vertices of a star go, and the words of their edges after that.
#include <algorithm>
#include <cmath>

#include "lod/base/check.h"
#include "lod/progressive/surface_image.h"

namespace lod {
namespace {

/// A vertex this near, as a share of what its node's error is no less than, stays where it is: nobody will know.
constexpr double kNearShare = 0.5;

}  // namespace

SurfaceImage::Sector::Sector(const Triangle& of) : triangle(of) {
    constexpr double kThin2 = 1e-8;  // of sines: then rounding turns the normal by 1e-12 at the most
    const glm::dvec3 ab = of.b - of.a, ac = of.c - of.a;
    const glm::dvec3 across = glm::cross(ab, ac);
    const double size2 = glm::dot(across, across);
    is_thin = !(size2 > kThin2 * glm::dot(ab, ab) * glm::dot(ac, ac));
    if (is_thin) return;
    normal = across / glm::sqrt(size2);
    inward = {glm::cross(normal, ab), glm::cross(normal, of.c - of.b), glm::cross(ac, normal)};
}

bool SurfaceImage::Sector::is_below(const glm::dvec3& place, double limit_m) const {
    const glm::dvec3 from_a = place - triangle.a;
    return std::abs(glm::dot(normal, from_a)) <= limit_m && glm::dot(inward[0], from_a) >= 0.0 &&
           glm::dot(inward[2], from_a) >= 0.0 && glm::dot(inward[1], place - triangle.b) >= 0.0 && !is_thin;
}

/// Sends every vertex of the star to the nearest new triangle.
void SurfaceImage::move_members() {
    for (size_t i = 0; i < members_.size(); ++i) {
        Member& member = members_[i];
        member.from = member.to = sector_of_[start_[i] / 3];
        CHECK(member.from != kNone);
        const glm::dvec3 place = at(member.vertex);
        if (border_of_[member.vertex] == kNoCorner)
            move_inner(member, place);
        else
            move_border(member, place);
        const uint32_t triangle = fan_.corners[member.to] / 3;
        triangle_of_[member.vertex] = triangle;
        on_[triangle].push_back(member.vertex);
        if (member.from == member.to) continue;
        for (uint32_t j = incident_begin_[member.vertex]; j < incident_begin_[member.vertex + 1]; ++j)
            __builtin_prefetch(&edges_[incident_[j]], 1);  // looked at when all are moved
    }
}

/// Edges whose ends do not go the same way are written anew.
void SurfaceImage::touch_moved() {
    for (const Member& member : members_) {
        if (member.from == member.to && !member.passes_p) continue;
        const bool is_inner = border_of_[member.vertex] == kNoCorner;
        for (uint32_t j = incident_begin_[member.vertex]; j < incident_begin_[member.vertex + 1]; ++j) {
            const FullEdge& edge = edges_[incident_[j]];
            const uint32_t beside = member_of_[edge.u == member.vertex ? edge.v : edge.u];
            const bool is_alike = is_inner && edge.word.empty() && beside != kNone &&
                                  members_[beside].from == member.from && members_[beside].to == member.to &&
                                  members_[beside].is_ccw == member.is_ccw;
            if (!is_alike) touch(incident_[j]);
        }
    }
}

/// What is clearly above a new triangle, nearer than others, goes there without being measured; nearest sectors first.
bool SurfaceImage::is_unnoticed(Member& member, const glm::dvec3& place, double unnoticed_m) const {
    const size_t count = fan_.corners.size();
    for (size_t away = 0; away < count; ++away) {
        const size_t turn = (away + 1) / 2;  // 0, 1 clockwise, 1 counter-clockwise, 2 clockwise ...
        const bool is_ccw = away % 2 == 0;
        const size_t sector = member.from + (is_ccw ? turn : count - turn);
        const size_t to = sector >= count ? sector - count : sector;
        if (!sectors_[to].is_below(place, away == 0 ? unnoticed_m : kNearShare * unnoticed_m)) continue;
        member.to = static_cast<uint32_t>(to);
        member.is_ccw = fan_.is_closed ? is_ccw : member.to > member.from;
        return true;
    }
    return false;
}

/// What is near stays. Else downhill first; where that ends farther off than anything before, every sector is tried.
void SurfaceImage::move_inner(Member& member, const glm::dvec3& place) {
    const size_t count = fan_.corners.size();
    const double unnoticed_m = std::max(enough_m_, glm::sqrt(bound2_)), near_m = kNearShare * unnoticed_m;
    if (is_unnoticed(member, place, unnoticed_m)) return;
    double least2 = squared_distance(place, sectors_[member.from].triangle);
    if (least2 <= near_m * near_m) return;
    const auto attempt = [&](size_t sector) {
        const double apart2 = squared_distance(place, sectors_[sector].triangle);
        if (apart2 >= least2) return false;
        least2 = apart2;
        member.to = static_cast<uint32_t>(sector);
        return true;
    };
    for (const bool is_up : {true, false}) {
        size_t at = member.to;
        do {
            if (!fan_.is_closed && at == (is_up ? count - 1 : 0)) break;
            at = is_up ? (at + 1) % count : (at + count - 1) % count;
        } while (least2 > 0.0 && attempt(at));
    }
    for (size_t sector = 0; sector < count && least2 > unnoticed_m * unnoticed_m; ++sector)
        attempt(sector);
    const size_t ccw = (member.to + count - member.from) % count;
    member.is_ccw = fan_.is_closed ? 2 * ccw <= count : member.to > member.from;
    bound2_ = std::max(bound2_, least2);
}

/// A border vertex stays on the border: on its edge, or on the other one of p.
void SurfaceImage::move_border(Member& member, const glm::dvec3& place) {
    CornerId& border = border_of_[member.vertex];
    const CornerId out = fan_.corners.front(), in = prev_corner(fan_.corners.back());
    const bool is_at_p = !fan_.is_closed;
    if (is_at_p && border == removed_[0].contracted) border = mesh_.node(border) == centre_ ? out : in;
    const auto apart2 = [&](CornerId corner) {
        return squared_distance(place,
                                nearest_on_segment(place, at(mesh_.node(corner)), at(mesh_.head(corner))));
    };
    if (is_at_p && (border == out || border == in)) {
        const bool was_out = border == out,
                   is_out = apart2(out) < apart2(in) || (was_out && apart2(out) == apart2(in));
        member.passes_p = was_out != is_out;
        member.is_forward = is_out;
        border = is_out ? out : in;
        member.to = is_out ? 0 : static_cast<uint32_t>(fan_.corners.size() - 1);
    }
    member.is_ccw = member.to > member.from;
    bound2_ = std::max(bound2_, apart2(border));
}

/// The word of an edge after the collapse and the moves of its ends.
void SurfaceImage::rewrite(uint32_t index) {
    FullEdge& edge = edges_[index];
    const Member* u = member_of_[edge.u] == kNone ? nullptr : &members_[member_of_[edge.u]];
    const Member* v = member_of_[edge.v] == kNone ? nullptr : &members_[member_of_[edge.v]];
    const bool stays = edge.right != kNoCorner && (u == nullptr || u->to == u->from) &&
                       (v == nullptr || v->to == v->from) &&
                       std::all_of(edge.word.begin(), edge.word.end(),
                                   [this](CornerId letter) { return rule_of_[letter] == kNone; });
    if (stays) return suspect(edge);
    scratch_.clear();
    const auto add = [&](CornerId letter) { append_reduced(mesh_, p_, letter, scratch_); };
    if (u != nullptr) walk_fan(fan_, u->to, u->from, !u->is_ccw, add);
    for (CornerId letter : edge.word) {
        if (rule_of_[letter] == kNone) {
            add(letter);
        } else {
            for (CornerId other : rules_[rule_of_[letter]])
                add(other);
        }
    }
    if (v != nullptr) walk_fan(fan_, v->from, v->to, v->is_ccw, add);
    edge.word.assign(scratch_.begin(), scratch_.end());
    suspect(edge);
    if (edge.right == kNoCorner) rewrite_passes(index, u, v);
}

void SurfaceImage::rewrite_passes(uint32_t edge, const Member* u, const Member* v) {
    Passes &old = passes_[edge], passes;
    const auto add = [&](const Pass& pass) {
        const bool is_undone =
            pass.node == p_ && !passes.empty() && passes.back() == Pass{p_, !pass.is_forward};
        if (is_undone)
            passes.pop_back();
        else
            passes.push_back(pass);
    };
    if (u != nullptr && u->passes_p) add({p_, !u->is_forward});
    for (const Pass& pass : old) {
        if (pass.node == centre_)
            add({p_, pass.is_forward});
        else if (pass.node != other_)
            add(pass);
    }
    if (v != nullptr && v->passes_p) add({p_, v->is_forward});
    old = std::move(passes);
}

}  // namespace lod
