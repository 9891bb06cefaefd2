// PageJudge: how many pixels a page is worth to eyes that move.
//
// A page is a sphere around all it speaks of, with the error that stays as long as the page is away. It is worth
// the screen error of that (lod/screen_error.h), the largest over the eyes now and where they will be in 0.5, 1 and
// 2 s; half as much where it is out of view, so that a turn finds it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lod/view.h"
#include "terrain/store/store_file.h"

namespace terrain {

/// Where eyes are and how they move.
struct MovingEye {
    lod::View view;
    glm::dvec3 velocity_mps{0.0};
};

class PageJudge {
  public:
    /// Cost: 0.5 us a page.
    explicit PageJudge(const StoreFile& store);

    /// The eyes that count from now on.
    void look(const std::vector<MovingEye>& eyes);

    /// Pixels, of an entry of the store; 0 where its absence nobody can see at any distance.
    float worth_px(size_t page) const;

    /// Metres: half the width of a page of the finest group, the smallest motion that changes much.
    double finest_reach_m() const { return finest_reach_m_; }

    static constexpr size_t bytes_per_page() { return sizeof(Ball); }

  private:
    struct Ball {
        glm::vec3 centre_m{0.0f};  // from the anchor
        float radius_m = 0.0f;
        float error_m = 0.0f;
    };
    struct Gaze {
        lod::ViewMetric metric;
        glm::dvec3 eye{0.0};  // from the anchor
        double weight = 1.0;
    };

    glm::dvec3 anchor_world_{0.0};
    double finest_reach_m_ = 0.0;
    std::vector<Ball> balls_;  // [entry]; level pages are worth nothing
    std::vector<Gaze> gazes_;
};

}  // namespace terrain
