#include "terrain/vertex_glides.h"

#include <algorithm>

namespace terrain {
namespace {

bool is_before(const VertexGlide& glide, DiamondIndex index) {
    return glide.index < index;
}

float smooth(float x) {
    return x * x * (3.0f - 2.0f * x);
}

}  // namespace

const VertexGlide* VertexGlides::find(DiamondIndex index, int level) const {
    const std::vector<VertexGlide>& glides = levels_[static_cast<size_t>(level)];
    const auto at = std::lower_bound(glides.begin(), glides.end(), index, is_before);
    return at != glides.end() && at->index == index ? &*at : nullptr;
}

float VertexGlides::weight(const VertexGlide& glide, double now_s) const {
    // What has less far to go takes less time, so that the speed is the same.
    const double whole = duration_s_ * static_cast<double>(std::abs(glide.to - glide.from));
    if (now_s >= glide.start_s + whole) return glide.to;
    const double done = std::max(now_s - glide.start_s, 0.0) / whole;
    return glide.from + (glide.to - glide.from) * smooth(static_cast<float>(done));
}

void VertexGlides::turn(VertexGlide& glide, bool leaves, double now_s) const {
    glide.from = weight(glide, now_s);
    glide.to = leaves ? 1.0f : 0.0f;
    glide.start_s = now_s;
}

glm::vec3 VertexGlides::shown_base_m(const VertexGlide& glide) const {
    glm::vec3 shown = glide.base_from_place_m;
    const GlideBase& base = glide.base;
    for (size_t end = 0; end < 3; ++end) {
        if (base.shares[end] > 0.0f)
            shown += base.shares[end] * displacement_m(base.ends[end], base.levels[end]);
    }
    return shown;
}

const VertexGlide& VertexGlides::start(const VertexGlide& glide, int level, bool leaves, double now_s) {
    std::vector<VertexGlide>& glides = level_of(level);
    const auto at = std::lower_bound(glides.begin(), glides.end(), glide.index, is_before);
    if (at != glides.end() && at->index == glide.index) {
        turn(*at, leaves, now_s);
        return *at;
    }
    VertexGlide fresh = glide;
    fresh.from = leaves ? 0.0f : 1.0f;
    fresh.to = 1.0f - fresh.from;
    fresh.start_s = now_s;
    fresh.weight = fresh.from;
    fresh.shown_m = fresh.before_m = fresh.weight * shown_base_m(glide);
    farthest_m_ = std::max(farthest_m_, glm::length(fresh.shown_m));
    ++count_;
    return *glides.insert(at, fresh);
}

void VertexGlides::turn_round(DiamondIndex index, int level, bool leaves, double now_s) {
    std::vector<VertexGlide>& glides = level_of(level);
    const auto at = std::lower_bound(glides.begin(), glides.end(), index, is_before);
    if (at != glides.end() && at->index == index) turn(*at, leaves, now_s);
}

void VertexGlides::drop(DiamondIndex index, int level) {
    std::vector<VertexGlide>& glides = level_of(level);
    const auto at = std::lower_bound(glides.begin(), glides.end(), index, is_before);
    if (at == glides.end() || at->index != index) return;
    glides.erase(at);
    --count_;
}

void VertexGlides::clear() {
    for (std::vector<VertexGlide>& glides : levels_)
        glides.clear();
    count_ = 0;
    farthest_m_ = 0.0f;
}

void VertexGlides::advance(double now_s, std::vector<DiamondIndex>& back) {
    back.clear();
    farthest_m_ = 0.0f;
    for (std::vector<VertexGlide>& glides : levels_) {
        for (VertexGlide& glide : glides) {
            glide.weight = weight(glide, now_s);
            glide.before_m = glide.shown_m;
            glide.shown_m = glide.weight * shown_base_m(glide);
            farthest_m_ = std::max(farthest_m_, glm::length(glide.shown_m));
            if (glide.to == 1.0f && glide.weight == 1.0f) back.push_back(glide.index);
        }
    }
    // Arrived, and shown there once: dropped with the next frame, so that its last step is drawn, too.
    for (std::vector<VertexGlide>& glides : levels_) {
        count_ -= std::erase_if(glides, [](const VertexGlide& glide) {
            return glide.to == 0.0f && glide.shown_m == glm::vec3(0.0f) && glide.before_m == glm::vec3(0.0f);
        });
    }
}

glm::vec3 VertexGlides::displacement_m(DiamondIndex index, int level) const {
    const VertexGlide* glide = find(index, level);
    return glide ? glide->shown_m : glm::vec3(0.0f);
}

}  // namespace terrain
