// Extremes: the farthest points of something both ways along thirteen directions; enough to move a face by.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace objects {

class Extremes {
  public:
    static constexpr size_t kWays = 13, kCount = 2 * kWays;

    Extremes() = default;
    explicit Extremes(const glm::dvec3& point) { farthest_.fill(point); }

    void add(const glm::dvec3& point) {
        for (size_t way = 0; way < kWays; ++way) {
            if (along(way, point) > along(way, farthest_[2 * way])) farthest_[2 * way] = point;
            if (along(way, point) < along(way, farthest_[2 * way + 1])) farthest_[2 * way + 1] = point;
        }
    }

    /// Some of those added, some perhaps more than once.
    std::span<const glm::dvec3, kCount> points() const { return farthest_; }

    /// Corners of the box around all that were added.
    glm::dvec3 high() const { return {farthest_[0].x, farthest_[2].y, farthest_[4].z}; }
    glm::dvec3 low() const { return {farthest_[1].x, farthest_[3].y, farthest_[5].z}; }

  private:
    /// The axes come first.
    static constexpr std::array<std::array<double, 3>, kWays> kWay = {{{1, 0, 0},
                                                                       {0, 1, 0},
                                                                       {0, 0, 1},
                                                                       {1, 1, 0},
                                                                       {1, -1, 0},
                                                                       {1, 0, 1},
                                                                       {1, 0, -1},
                                                                       {0, 1, 1},
                                                                       {0, 1, -1},
                                                                       {1, 1, 1},
                                                                       {1, 1, -1},
                                                                       {1, -1, 1},
                                                                       {-1, 1, 1}}};

    static double along(size_t way, const glm::dvec3& point) {
        return kWay[way][0] * point.x + kWay[way][1] * point.y + kWay[way][2] * point.z;
    }

    std::array<glm::dvec3, kCount> farthest_{};
};

}  // namespace objects
