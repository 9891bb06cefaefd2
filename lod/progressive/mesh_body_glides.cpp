// Gliding: split vertices glide home, superfluous ones glide to their node before they are collapsed, and what still
// jumps is told.
#include <algorithm>
#include <cmath>

#include "lod/progressive/mesh_body.h"

namespace lod {
void MeshBody::drop_glide(NodeId node) {
    const NodeGlide* glide = glides_.find(node);
    if (glide == nullptr) return;
    if (glide->shown_m != glm::vec3(0.0f)) strayed_.push_back(node);
    glides_.drop(node);
}

/// How far the children are shown from their node, the farther one.
float MeshBody::way_m(uint32_t record) const {
    if (glides_.all().empty()) return mesh().heads[record].way_m;
    const std::vector<glm::vec3>& position = mesh().hierarchy.position;
    const auto [a, b] = mesh().hierarchy.children[record];
    const glm::vec3 place = position[node_of(record)], to_a = position[a] + glides_.displacement_m(a) - place,
                    to_b = position[b] + glides_.displacement_m(b) - place;
    return std::sqrt(std::max(glm::dot(to_a, to_a), glm::dot(to_b, to_b)));
}

double MeshBody::pop_px(uint32_t record) const {
    FourWays ways;
    ways.set(0, mesh().hierarchy.position[node_of(record)], way_m(record));
    return ways.worst_px(ranks_.eyes());
}

/// They jump to it, or from it. In a plane nobody sees it, and in a cut nothing is a movement.
void MeshBody::note_pop(uint32_t record) {
    if (is_cut_ || ranks_.bucket(record) <= kFlatBucket) return;
    waiting_pops_.set(waiting_count_++, mesh().hierarchy.position[node_of(record)], way_m(record));
    if (waiting_count_ == 4) take_pops();
}

void MeshBody::forget_pops() {
    jump_px_ = 0.0;
    waiting_pops_ = {};
    waiting_count_ = 0;
}

/// Takes those that waited to be looked at four at a time.
void MeshBody::take_pops() {
    const double jump_px = this->jump_px();
    forget_pops();
    jump_px_ = jump_px;
}

/// Sends both children to their node; false when they must jump, or need not move.
bool MeshBody::leave(uint32_t record) {
    if (!is_gliding(record)) return false;
    bool moves = false;
    for (NodeId child : mesh().hierarchy.children[record]) {
        const glm::vec3 to_m = mesh().hierarchy.position[node_of(record)] - mesh().hierarchy.position[child];
        if (to_m == glm::vec3(0.0f) && glides_.find(child) == nullptr) continue;
        glides_.leave(child, to_m, now_s_);
        moves = true;
    }
    if (!moves) return false;
    ranks_.unlink(record);
    ranks_.enqueue(record, NodeQueue::kLeave);
    leaving_triangles_ += mesh().removed(record).size();
    return true;
}

/// They are wanted after all.
void MeshBody::stay(uint32_t record) {
    for (NodeId child : mesh().hierarchy.children[record])
        glides_.turn_home(child, now_s_);
    leaving_triangles_ -= mesh().removed(record).size();
    ranks_.unlink(record);
    ranks_.enqueue(record, NodeQueue::kMerge);
}

bool MeshBody::has_left(uint32_t record) const {
    const auto& children = mesh().hierarchy.children[record];
    return std::all_of(children.begin(), children.end(), [&](NodeId child) {
        const NodeGlide* glide = glides_.find(child);
        return glide == nullptr || glide->has_arrived();
    });
}

/// Moves what is under way; collapses what has arrived, or calls it back where that is no longer legal.
void MeshBody::advance_glides() {
    glides_.advance(now_s_);
    measure_glides();
    back_.clear();
    for (const NodeGlide& glide : glides_.all()) {
        if (glide.leaves && glide.has_arrived())
            back_.push_back(record_of(mesh().hierarchy.parent[glide.node]));
    }
    std::sort(back_.begin(), back_.end());
    for (uint32_t record : back_) {
        if (ranks_.queue(record) != NodeQueue::kLeave || !has_left(record)) continue;
        if (cut_.collapse_blocker(node_of(record)) != kNoNode) {
            stay(record);
            continue;
        }
        leaving_triangles_ -= mesh().removed(record).size();
        merge_one(record);
    }
}

void MeshBody::measure_glides() {
    glide_px_ = glide_error_.measure_px(cut_, glides_, ranks_.eyes());
    forget_pops();
    const std::span<const NodeGlide> glides = glides_.all();
    for (size_t begin = 0; begin < glides.size(); begin += 4) {
        FourWays steps;
        for (size_t i = begin; i < std::min(begin + 4, glides.size()); ++i) {
            const glm::vec3 place = mesh().hierarchy.position[glides[i].node];
            steps.set(static_cast<int>(i - begin), place,
                      glm::length(glides[i].shown_m - glides[i].before_m));
        }
        jump_px_ = std::max(jump_px_, steps.worst_px(ranks_.eyes()));
    }
}

std::string MeshBody::validate() const {
    std::string fault = cut_.validate();
    if (fault.empty()) fault = ranks_.validate();
    if (!fault.empty()) return fault;
    uint64_t leaving = 0;
    for (uint32_t record = 0; record < mesh().hierarchy.collapse_count(); ++record) {
        const NodeId node = node_of(record);
        const NodeQueue queue = ranks_.queue(record);
        const bool is_merge = !cut_.is_active(node) && cut_.are_children_active(node);
        const bool is_right = cut_.is_active(node) ? queue == NodeQueue::kSplit
                              : is_merge           ? queue > NodeQueue::kSplit
                                                   : queue == NodeQueue::kNone;
        if (!is_right) return "node " + std::to_string(node) + " is in the wrong queue";
        if (queue == NodeQueue::kLeave) leaving += mesh().removed(record).size();
    }
    for (const NodeGlide& glide : glides_.all()) {
        if (!cut_.is_active(glide.node)) return "node " + std::to_string(glide.node) + " glides and is gone";
    }
    return leaving == leaving_triangles_ ? "" : "miscounts what leaves";
}

}  // namespace lod
