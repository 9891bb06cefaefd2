// EyeOdometer: how far the eyes have walked and turned, summed over all frames, and where they are now.
//
// A record that sleeps keeps the two readings at which its guard may be used up (Alarm); comparing them with the
// odometer's is all a frame does about it.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/base/float4.h"
#include "lod/sight_metric.h"
#include "lod/view.h"

namespace lod {

class EyeOdometer {
  public:
    /// @param typical_m  at this distance turning moves a point as far as walking does
    explicit EyeOdometer(double typical_m = 2000.0) : typical_m_(typical_m) {}

    /// What a frame did to the sleepers' readings.
    enum class Step : uint8_t {
        kAdvanced,  ///< the readings grew
        kRewound,  ///< the readings start at 0 again: shift what sleeps by walked_before_m, turned_before_rad
        kIncomparable,  ///< other eyes or optics: nothing said before holds
    };

    /// Takes the frame's views. @param anchor_world  origin of the eyes' coordinates
    Step advance(std::span<const View> views, const glm::dvec3& anchor_world);

    std::span<const AnchoredEye> eyes() const { return eyes_; }
    /// Those of the frame before; as many, unless that frame cannot be compared.
    std::span<const AnchoredEye> eyes_before() const { return eyes_before_; }
    float walked_m() const { return static_cast<float>(walked_m_); }
    float turned_rad() const { return static_cast<float>(turned_rad_); }
    /// What the last frame added, for the eye that moved the most.
    double step_m() const { return step_m_; }
    double step_rad() const { return step_rad_; }
    double walked_before_m() const { return walked_before_m_; }
    double turned_before_rad() const { return turned_before_rad_; }

    /// Readings at which guards are used up at the earliest, in `walk_m` and `turn_rad`. A guard is shared out
    /// between walking and turning as the last frame's motion was.
    void alarms(const FourEvaluations& now, Float4& walk_m, Float4& turn_rad) const {
        const Float4 walk = now.guard_m * walk_share_;
        const Float4 turn = (now.guard_m - walk) / (now.distance_m + walk + 1e-6f);
        walk_m = (walked_m() + walk) * (1.0f - 0x1p-20f);
        turn_rad = (turned_rad() + turn) * (1.0f - 0x1p-20f);
    }

  private:
    double typical_m_;
    std::vector<AnchoredEye> eyes_, eyes_before_;
    double walked_m_ = 0.0, turned_rad_ = 0.0;
    double step_m_ = 0.0, step_rad_ = 0.0;
    double walked_before_m_ = 0.0, turned_before_rad_ = 0.0;
    float walk_share_ = 0.5f;
};

}  // namespace lod
