// A flight at 300 m/s in wide curves over a planar raster, 1000 m above its highest place.
#pragma once

#include <cmath>

#include "terrain/diamond_table.h"
#include "tests/terrain/test_relief.h"

namespace bench {

inline constexpr double kSpeed_mps = 300.0;

class FlightPath {
  public:
    explicit FlightPath(const terrain::DiamondTable& table)
        : middle_(table.frame.world_from_sample(table.domain.width / 2, table.domain.height / 2, 0.0)),
          radius_m_(0.2 * table.domain.width * table.frame.cell_m().x),
          height_m_(double(table.max_m) + 1000.0) {}

    /// A figure of eight, as fast all along as a Lissajous curve allows: 300 m/s on average.
    glm::dvec3 eye_at(double time_s) const {
        const double a = kSpeed_mps * time_s / (1.6 * radius_m_);
        return {middle_.x + 2.0 * radius_m_ * std::sin(a), middle_.y + radius_m_ * std::sin(2.0 * a),
                height_m_};
    }
    lod::View view_at(double time_s) const {
        const glm::dvec3 way = eye_at(time_s + 0.01) - eye_at(time_s);
        return terrain_test::level_view(eye_at(time_s), std::atan2(way.x, way.y), -0.12);
    }

  private:
    glm::dvec3 middle_;
    double radius_m_, height_m_;
};

}  // namespace bench
