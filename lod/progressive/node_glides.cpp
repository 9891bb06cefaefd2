#include "lod/progressive/node_glides.h"

#include <algorithm>

#include "lod/base/check.h"

namespace lod {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

float smooth(float x) {
    return x * x * (3.0f - 2.0f * x);
}

}  // namespace

NodeGlides::NodeGlides(uint32_t node_count, double duration_s) : duration_s_(duration_s) {
    if (duration_s <= 0.0) return;
    index_.assign(node_count, kNone);
    glides_.reserve(256);
}

const NodeGlide* NodeGlides::find(NodeId node) const {
    if (index_.empty() || index_[node] == kNone) return nullptr;
    return &glides_[index_[node]];
}

glm::vec3 NodeGlides::displacement_m(NodeId node) const {
    const NodeGlide* glide = find(node);
    return glide != nullptr ? glide->shown_m : glm::vec3(0.0f);
}

NodeGlide& NodeGlides::make(NodeId node) {
    DCHECK(duration_s_ > 0.0);
    if (index_[node] == kNone) {
        index_[node] = static_cast<uint32_t>(glides_.size());
        glides_.push_back({.node = node});
    }
    return glides_[index_[node]];
}

void NodeGlides::come(NodeId node, const glm::vec3& from_m, double now_s) {
    NodeGlide& glide = make(node);
    glide = {.node = node, .from_m = from_m, .way_m = glm::length(from_m), .start_s = now_s};
    glide.shown_m = glide.before_m = from_m;
}

void NodeGlides::leave(NodeId node, const glm::vec3& to_m, double now_s) {
    NodeGlide& glide = make(node);
    glide.leaves = true;
    glide.from_m = glide.shown_m;
    glide.to_m = to_m;
    glide.way_m = std::max(glide.way_m, glm::length(to_m));
    glide.start_s = now_s;
}

void NodeGlides::turn_home(NodeId node, double now_s) {
    if (find(node) == nullptr) return;
    NodeGlide& glide = glides_[index_[node]];
    glide.leaves = false;
    glide.from_m = glide.shown_m;
    glide.to_m = glm::vec3(0.0f);
    glide.start_s = now_s;
}

void NodeGlides::drop(NodeId node) {
    if (find(node) == nullptr) return;
    const uint32_t hole = index_[node];
    index_[node] = kNone;
    if (hole + 1 < glides_.size()) {
        glides_[hole] = glides_.back();
        index_[glides_[hole].node] = hole;
    }
    glides_.pop_back();
}

void NodeGlides::clear() {
    for (const NodeGlide& glide : glides_)
        index_[glide.node] = kNone;
    glides_.clear();
}

/// What has less far to go takes less time, so that the speed is the same.
glm::vec3 NodeGlides::place_at(const NodeGlide& glide, double now_s) const {
    const float left_m = glm::distance(glide.from_m, glide.to_m);
    if (left_m == 0.0f) return glide.to_m;
    const double whole_s = duration_s_ * std::min(1.0, double(left_m) / double(glide.way_m));
    const double done = (now_s - glide.start_s) / whole_s;
    if (done >= 1.0) return glide.to_m;
    return glide.from_m + smooth(static_cast<float>(std::max(done, 0.0))) * (glide.to_m - glide.from_m);
}

void NodeGlides::advance(double now_s) {
    for (size_t i = 0; i < glides_.size();) {
        NodeGlide& glide = glides_[i];
        const glm::vec3 now = place_at(glide, now_s);
        const bool is_home = !glide.leaves && now == glm::vec3(0.0f) && glide.shown_m == now;
        glide.before_m = glide.shown_m;
        glide.shown_m = now;
        if (is_home) {
            drop(glide.node);
        } else {
            ++i;
        }
    }
}

}  // namespace lod
