// SurfaceImage: turns round a node, owners of nodes, and what is to be measured in a star.
#include <algorithm>

#include "lod/progressive/surface_image.h"

namespace lod {

/// Letters that a full turn of a vertex round p would add to its edges' words, less those that it would cancel; where that is not
/// below 0, perhaps only some of them.
/// @param is_ccw  the way its edges go round p now
int SurfaceImage::excess_turns(uint32_t vertex, bool is_ccw) const {
    const auto around = static_cast<int>(fan_.corners.size());
    int added = 0;
    for (uint32_t i = incident_begin_[vertex], end = incident_begin_[vertex + 1]; i < end; ++i) {
        if (added >= around * static_cast<int>(end - i)) break;  // the rest cannot cancel so many
        const FullEdge& edge = edges_[incident_[i]];
        const size_t count = edge.word.size();
        const bool is_tail = edge.u == vertex;
        int run = 0;
        while (run < around && run < static_cast<int>(count)) {
            const CornerId letter =
                edge.word[is_tail ? static_cast<size_t>(run) : count - 1 - static_cast<size_t>(run)];
            const NodeId pivot = is_ccw == is_tail ? mesh_.head(letter) : mesh_.node(letter);
            if (pivot != p_) break;
            ++run;
        }
        added += around - 2 * run;
    }
    return added;
}

/// Winds a vertex once round p against the way its edges go.
void SurfaceImage::turn_vertex(uint32_t vertex, bool is_ccw) {
    const size_t count = fan_.corners.size(), sector = sector_of_[triangle_of_[vertex]];
    for (uint32_t i = incident_begin_[vertex]; i < incident_begin_[vertex + 1]; ++i) {
        FullEdge& edge = edges_[incident_[i]];
        scratch_.clear();
        const auto add = [&](CornerId letter) { append_reduced(mesh_, p_, letter, scratch_); };
        const auto turn = [&](bool turns_ccw) {
            const size_t next = (turns_ccw ? sector + 1 : sector + count - 1) % count;
            if (count > 1) walk_fan(fan_, sector, next, turns_ccw, add);
            walk_fan(fan_, next, sector, turns_ccw, add);
        };
        if (edge.u == vertex) turn(!is_ccw);
        for (CornerId letter : edge.word)
            add(letter);
        if (edge.v == vertex) turn(is_ccw);
        edge.word.assign(scratch_.begin(), scratch_.end());
        suspect(edge);
        touch(incident_[i]);
    }
}

/// Remembers the ends of an edge from which it goes more than half round p, and which way: only with such an edge can a
/// turn pay.
void SurfaceImage::suspect(const FullEdge& edge) {
    const size_t half = fan_.corners.size() / 2, count = edge.word.size();
    if (count <= half) return;
    const auto look_from = [&](uint32_t vertex, bool is_tail) {
        if (member_of_[vertex] == kNone) return;
        const auto letter = [&](size_t i) { return edge.word[is_tail ? i : count - 1 - i]; };
        const bool is_out = mesh_.node(letter(0)) == p_;
        if (!is_out && mesh_.head(letter(0)) != p_) return;
        size_t run = 1;
        while (run <= half && run < count &&
               (is_out ? mesh_.node(letter(run)) : mesh_.head(letter(run))) == p_)
            ++run;
        if (run > half) suspects_.push_back({vertex, is_out != is_tail});
    };
    look_from(edge.u, true);
    look_from(edge.v, false);
}

/// Vertices that went round p the long way, as their edges' words tell, go back.
void SurfaceImage::untwist() {
    constexpr int kPasses = 4;
    if (!fan_.is_closed || fan_.corners.size() < 2) return;
    for (int pass = 0; pass < kPasses; ++pass) {
        std::sort(suspects_.begin(), suspects_.end());
        suspects_.erase(std::unique(suspects_.begin(), suspects_.end()), suspects_.end());
        bool is_changed = false;
        for (size_t i = 0, count = suspects_.size(); i < count; ++i) {
            const auto [vertex, is_ccw] = suspects_[i];
            if (border_of_[vertex] != kNoCorner || excess_turns(vertex, is_ccw) >= 0) continue;
            turn_vertex(vertex, is_ccw);
            is_changed = true;
        }
        if (!is_changed) return;
    }
}

double SurfaceImage::owner_distance(NodeId node, uint32_t triangle) const {
    const auto& [a, b, c] = triangles_[triangle];
    return glm::sqrt(squared_distance(at(node), Triangle{at(a), at(b), at(c)}));
}

/// Searches the full triangles around `from` for one that is nearer to p; on the way none may be farther than `apart`, as
/// many are alike where a vertex is nearest. The way stands in way_, its end last.
bool SurfaceImage::find_way(uint32_t from, double apart) {
    constexpr size_t kMostSteps = 96;
    way_.assign(1, {from, 0, 0, apart});
    for (size_t i = 0; i < way_.size() && way_.size() < kMostSteps; ++i) {
        const uint32_t triangle = way_[i].triangle;
        for (CornerId corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
            const FullEdge& edge = edges_[edge_of_[corner]];
            if (edge.right == kNoCorner) continue;
            const uint32_t to = (edge.left == corner ? edge.right : edge.left) / 3;
            const bool is_known =
                std::any_of(way_.begin(), way_.end(), [to](const Step& step) { return step.triangle == to; });
            if (is_known) continue;
            const double there = owner_distance(p_, to);
            if (there > apart * (1.0 + 1e-9)) continue;
            way_.push_back({to, static_cast<uint32_t>(i), edge_of_[corner], there});
            if (there < apart * (1.0 - 1e-9)) return true;
        }
    }
    return false;
}

/// p takes over the centre's owner, then goes to nearer ones.
void SurfaceImage::find_owner() {
    for (NodeId node : {centre_, other_}) {
        if (owner_[node] != kNone) owned_[owner_[node]].erase(node);
    }
    if (owner_[centre_] == kNone) return;
    owner_[p_] = owner_[centre_];
    owned_[owner_[p_]].push_back(p_);
    double apart = owner_distance(p_, owner_[p_]);
    std::vector<uint32_t> steps;
    for (bool is_moving = true; is_moving && apart > enough_m_;) {
        is_moving = find_way(owner_[p_], apart);
        steps.clear();
        for (size_t i = way_.size() - 1; i > 0; i = way_[i].before)
            steps.push_back(static_cast<uint32_t>(i));
        for (size_t i = steps.size(); is_moving && i-- > 0;)
            is_moving = flip(way_[steps[i]].edge, owner_[p_], way_[steps[i]].triangle);
        apart = owner_distance(p_, owner_[p_]);
    }
    owner_m_[p_] = apart;
}

/// Gives p from one full triangle to its neighbour across an edge, whose image then passes p on the other side.
bool SurfaceImage::flip(uint32_t index, uint32_t from, uint32_t to) {
    FullEdge& edge = edges_[index];
    before_.assign(edge.word.begin(), edge.word.end());
    if (!send_round(edge, edge.left / 3 != from)) return false;
    owned_[from].erase(p_);
    owned_[to].push_back(p_);
    if (can_fill(from) && can_fill(to)) {
        owner_[p_] = to;
        suspect(edge);
        touch(index);
        return true;
    }
    edge.word.assign(before_.begin(), before_.end());
    owned_[to].erase(p_);
    owned_[from].push_back(p_);
    return false;
}

/// Inserts a full turn round p where the edge's image is in the star; best where it goes round p the other way.
bool SurfaceImage::send_round(FullEdge& edge, bool is_ccw) {
    size_t place = edge.word.size() + 1;
    uint32_t sector = kNone;
    for (size_t i = 0; i <= edge.word.size(); ++i) {
        const uint32_t triangle = i == 0 ? triangle_of_[edge.u] : mesh_.mate(edge.word[i - 1]) / 3;
        if (sector_of_[triangle] == kNone) continue;
        const bool is_counter =
            i < edge.word.size() && (is_ccw ? mesh_.node(edge.word[i]) : mesh_.head(edge.word[i])) == p_;
        if (sector != kNone && !is_counter) continue;
        place = i;
        sector = sector_of_[triangle];
        if (is_counter) break;
    }
    if (sector == kNone) return false;
    scratch_.assign(edge.word.begin(), edge.word.begin() + place);
    const auto add = [&](CornerId letter) { append_reduced(mesh_, p_, letter, scratch_); };
    const auto count = static_cast<uint32_t>(fan_.corners.size());
    const uint32_t next = is_ccw ? (sector + 1) % count : (sector + count - 1) % count;
    if (count > 1) walk_fan(fan_, sector, next, is_ccw, add);
    walk_fan(fan_, next, sector, is_ccw, add);
    for (size_t i = place; i < edge.word.size(); ++i)
        add(edge.word[i]);
    edge.word.assign(scratch_.begin(), scratch_.end());
    return true;
}

/// Whether a full triangle's image, the loop of its edges' words, can be drawn together.
bool SurfaceImage::can_fill(uint32_t triangle) {
    loop_.clear();
    for (CornerId corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
        const FullEdge& edge = edges_[edge_of_[corner]];
        if (edge.left == corner) {
            loop_.insert(loop_.end(), edge.word.begin(), edge.word.end());
        } else {
            for (size_t i = edge.word.size(); i-- > 0;)
                loop_.push_back(mesh_.mate(edge.word[i]));
        }
    }
    const auto& owned = owned_[triangle];
    return filling_.is_fillable(mesh_, loop_, {owned.begin(), owned.end()}, corner_of_);
}

bool SurfaceImage::is_sound() {
    for (uint32_t triangle = 0; triangle < owned_.size(); ++triangle) {
        if (!can_fill(triangle)) return false;
    }
    return true;
}

/// Who crosses p's edges, and who passes p.
void SurfaceImage::file_crossers() {
    for (CornerId corner : fan_.corners)
        crossers_[canonical(corner)].clear();
    for (uint32_t index : touched_) {
        const FullEdge& edge = edges_[index];
        for (CornerId letter : edge.word) {
            if (mesh_.node(letter) != p_ && mesh_.head(letter) != p_) continue;
            auto& crossers = crossers_[canonical(letter)];
            if (crossers.empty() || crossers.back() != index) crossers.push_back(index);
        }
        if (edge.right != kNoCorner) continue;
        const Passes& passes = passes_[index];
        if (std::any_of(passes.begin(), passes.end(), [this](const Pass& pass) { return pass.node == p_; }))
            passers_[p_].push_back(index);
    }
}

/// Full edges whose images cross a spoke. A border edge's image runs along the border, so it crosses where both coarse edge
/// and border have their node, on its right.
void SurfaceImage::note_crossings(CornerId spoke, StarMeasures& out) const {
    for (uint32_t index : crossers_[canonical(spoke)]) {
        const FullEdge& edge = edges_[index];
        if (edge.right != kNoCorner) {
            out.crossings.push_back({edge.u, edge.v});
            continue;
        }
        for (CornerId letter : edge.word) {
            if (canonical(letter) == canonical(spoke))
                out.passings.push_back({mesh_.node(letter), edge.u, edge.v});
        }
    }
}

void SurfaceImage::note_measures(const CollapseStep& step, StarMeasures& out) const {
    for (uint32_t index : passers_[p_])
        out.passings.push_back({p_, edges_[index].u, edges_[index].v});
    out.stars.push_back({step.children, step.position, glm::sqrt(bound2_), owner_m_[p_],
                         static_cast<uint32_t>(out.passings.size()), 0});
    for (CornerId corner : fan_.corners) {
        const CornerId mate = mesh_.mate(corner), outer = next_corner(corner);
        if (mate != kNoCorner) note_crossings(corner, out);
        out.spokes.push_back({corner, mate, outer, mesh_.node(outer), mesh_.head(outer),
                              static_cast<uint32_t>(out.crossings.size()),
                              static_cast<uint32_t>(out.passings.size())});
    }
    out.stars.back().spokes_end = static_cast<uint32_t>(out.spokes.size());
}

}  // namespace lod
