// EyeTracker: the velocity of eyes, from where they were in the last frames, and a clock that never goes back.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "terrain/store/page_judge.h"

namespace terrain {

class EyeTracker {
  public:
    /// Takes a frame's views. A velocity counts when two frames agree about it: a teleport is none.
    /// @param time_s  simulation time; may stand still or jump
    void advance(std::span<const lod::View> views, double time_s) {
        const double step_s = time_s - time_s_;
        time_s_ = time_s;
        age_s_ += std::clamp(step_s, kLeastStep_s, kMostStep_s);
        const bool is_comparable = views.size() == eyes_.size() && step_s > 0.0 && step_s <= kMostStep_s;
        eyes_.resize(views.size());
        raw_mps_.resize(views.size(), glm::dvec3(0.0));
        for (size_t i = 0; i < views.size(); ++i) {
            const glm::dvec3 raw =
                is_comparable ? (views[i].eye_world - eyes_[i].view.eye_world) / step_s : glm::dvec3(0.0);
            const double fastest = std::max(glm::length(raw), glm::length(raw_mps_[i]));
            const bool is_steady = glm::length(raw - raw_mps_[i]) <= 0.5 * fastest;
            eyes_[i] = {views[i], is_steady ? raw : glm::dvec3(0.0)};
            raw_mps_[i] = raw;
        }
    }

    const std::vector<MovingEye>& eyes() const { return eyes_; }
    /// Seconds since the beginning; grows with every frame, also while the simulation stands still.
    double age_s() const { return age_s_; }

  private:
    static constexpr double kLeastStep_s = 0.004, kMostStep_s = 1.0;

    double time_s_ = 0.0, age_s_ = 0.0;
    std::vector<MovingEye> eyes_;
    std::vector<glm::dvec3> raw_mps_;
};

}  // namespace terrain
