#include "lod/progressive/surface_image.h"

#include <algorithm>
#include <cmath>

#include "lod/base/check.h"

namespace lod {

void SurfaceImage::collapse(const CollapseStep& step, StarMeasures& out) {
    p_ = static_cast<NodeId>(positions_.size());
    positions_.emplace_back(step.position);
    enough_m_ = std::max({seen_m_[step.children[0]], seen_m_[step.children[1]], noise_m_});
    bound2_ = 0.0;
    choose_centre(step);
    gather_star(step);
    plan_contracted();
    carry_members();
    replace_star(step);
    move_members();
    touch_moved();
    for (uint32_t edge : touched_)
        rewrite(edge);
    untwist();
    find_owner();
    untwist();
    file_crossers();
    seen_m_[p_] = std::max({enough_m_, glm::sqrt(bound2_), owner_m_[p_]});
    note_measures(step, out);
    for (const Member& member : members_)
        member_of_[member.vertex] = kNone;
    for (uint32_t edge : touched_)
        is_touched_[edge] = 0;
    for (CornerId corner : fan_.corners)
        sector_of_[corner / 3] = kNone;
    for (CornerId corner : ruled_)
        rule_of_[corner] = kNone;
}

void SurfaceImage::expect(const CollapseStep& step) const {
    for (CornerId corner : step.kept) {
        __builtin_prefetch(&crossers_[canonical(corner)], 1);
        __builtin_prefetch(&crossers_[canonical(prev_corner(corner))], 1);
        __builtin_prefetch(&on_[corner / 3], 1);
    }
    for (uint32_t triangle : step.removed) {
        __builtin_prefetch(&crossers_[3 * triangle], 1);
        __builtin_prefetch(&crossers_[3 * triangle + 2], 1);
        __builtin_prefetch(&on_[triangle], 1);
    }
}

CornerId SurfaceImage::canonical(CornerId corner) const {
    return std::min(corner, mesh_.mate(corner));  // a border's mate is the largest number
}

/// The end that p continues: at a border the one that lies on it, else the nearer.
void SurfaceImage::choose_centre(const CollapseStep& step) {
    const auto [a, b] = step.children;
    const bool is_a_border = owner_[a] == kNone, is_b_border = owner_[b] == kNone;
    bool is_a_centre = squared_distance(at(a), at(p_)) <= squared_distance(at(b), at(p_));
    if (is_a_border != is_b_border) is_a_centre = is_a_border;
    centre_ = is_a_centre ? a : b;
    other_ = is_a_centre ? b : a;
}

void SurfaceImage::touch(uint32_t edge) {
    if (is_touched_[edge]) return;
    is_touched_[edge] = 1;
    touched_.push_back(edge);
    __builtin_prefetch(&edges_[edge], 1);  // rewritten in a moment
}

void SurfaceImage::touch_crossers(CornerId corner) {
    auto& crossers = crossers_[canonical(corner)];
    for (uint32_t edge : crossers)
        touch(edge);
    crossers.clear();
}

/// Everything that the star's inner edges and its two nodes concern.
void SurfaceImage::gather_star(const CollapseStep& step) {
    suspects_.clear(), star_.clear(), touched_.clear(), removed_.clear(), rules_.clear(), ruled_.clear();
    for (CornerId corner : step.kept) {
        star_.push_back(corner / 3);
        touch_crossers(corner);
        touch_crossers(prev_corner(corner));
    }
    for (uint32_t triangle : step.removed) {
        for (CornerId corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
            touch_crossers(corner);
        plan_removed(triangle);
    }
    for (NodeId node : {centre_, other_}) {
        for (uint32_t edge : passers_[node])
            touch(edge);
    }
}

/// Letters through the sides of a removed triangle.
void SurfaceImage::plan_removed(uint32_t triangle) {
    CornerId c = 3 * triangle, o = 3 * triangle;
    while (mesh_.node(c) != centre_)
        ++c;
    while (mesh_.node(o) != other_)
        ++o;
    Removed r;
    r.triangle = triangle;
    const bool is_outward = next_corner(c) == o;
    r.contracted = is_outward ? c : o;
    r.side_c = is_outward ? prev_corner(c) : c;
    r.side_o = is_outward ? o : prev_corner(o);
    r.beyond_c = mesh_.mate(r.side_c);
    r.beyond_o = mesh_.mate(r.side_o);
    const auto rule = [this](CornerId letter, CornerId instead) {
        if (letter == kNoCorner) return;
        rule_of_[letter] = static_cast<uint32_t>(rules_.size());
        ruled_.push_back(letter);
        Word& word = rules_.emplace_back();
        if (instead != kNoCorner) word.push_back(instead);
    };
    const bool is_inside = r.beyond_c != kNoCorner && r.beyond_o != kNoCorner;
    rule(r.side_c, is_inside ? r.beyond_o : kNoCorner);
    rule(r.side_o, kNoCorner);
    if (r.beyond_o == kNoCorner) rule(r.beyond_c, kNoCorner);
    rule(r.beyond_o, kNoCorner);
    removed_.push_back(r);
}

/// Letters through the edge that contracts go round the other end's remaining triangles.
void SurfaceImage::plan_contracted() {
    if (removed_.size() != 2) return;
    const CornerId begin = removed_[0].beyond_o, end = removed_[1].beyond_o;
    CHECK(begin != kNoCorner && end != kNoCorner);
    Word word, back;
    if (mesh_.node(begin) == other_) {
        for (CornerId at = begin; prev_corner(at) != end; at = mesh_.mate(prev_corner(at)))
            word.push_back(prev_corner(at));
    } else {
        for (CornerId at = next_corner(begin); at != end; at = next_corner(mesh_.mate(at)))
            word.push_back(at);
    }
    for (size_t i = word.size(); i-- > 0;)
        back.push_back(mesh_.mate(word[i]));
    for (size_t i = 0; i < 2; ++i) {
        rule_of_[removed_[i].contracted] = static_cast<uint32_t>(rules_.size());
        ruled_.push_back(removed_[i].contracted);
        rules_.push_back(std::move(i == 0 ? word : back));
    }
}

/// Takes the vertices off the old star; those of removed triangles stand beyond one of their sides now.
void SurfaceImage::carry_members() {
    members_.clear(), start_.clear();
    const auto carry = [this](uint32_t triangle, CornerId to) {
        for (uint32_t vertex : on_[triangle]) {
            member_of_[vertex] = static_cast<uint32_t>(members_.size());
            members_.push_back({.vertex = vertex});
            start_.push_back(to);
        }
        on_[triangle].clear();
    };
    for (uint32_t triangle : star_)
        carry(triangle, 3 * triangle);
    for (const Removed& r : removed_) {
        for (uint32_t vertex : on_[r.triangle]) {
            CornerId& border = border_of_[vertex];
            if (border == r.side_o) border = r.beyond_c;
            if (border == r.side_c) border = r.beyond_o;
        }
        carry(r.triangle, r.beyond_o != kNoCorner ? r.beyond_o : r.beyond_c);
    }
}

void SurfaceImage::replace_star(const CollapseStep& step) {
    for (const Removed& r : removed_)
        mesh_.close_gap(r.side_c, r.side_o);
    CHECK(!step.kept.empty());
    for (CornerId corner : step.kept)
        mesh_.set_node(corner, p_);
    mesh_.fan_at(step.kept.front(), fan_);
    CHECK(fan_.corners.size() == step.kept.size());
    sectors_.clear();
    for (size_t i = 0; i < fan_.corners.size(); ++i) {
        const CornerId corner = fan_.corners[i];
        sector_of_[corner / 3] = static_cast<uint32_t>(i);
        sectors_.emplace_back(coarse_triangle(corner));
        const CornerId outer = next_corner(corner);
        enough_m_ = std::max({enough_m_, owner_m_[mesh_.node(outer)], owner_m_[mesh_.head(outer)]});
        corner_of_[p_] = corner;
        corner_of_[mesh_.node(next_corner(corner))] = next_corner(corner);
        corner_of_[mesh_.node(prev_corner(corner))] = prev_corner(corner);
    }
}

Triangle SurfaceImage::coarse_triangle(CornerId corner) const {
    return {at(mesh_.node(corner)), at(mesh_.head(corner)), at(mesh_.node(prev_corner(corner)))};
}

}  // namespace lod
