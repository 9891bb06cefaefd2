// DiamondBound: the sphere that contains a diamond's two triangles, every sample they cover, and their error.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "data/ground_frame.h"
#include "lod/sight_metric.h"
#include "terrain/diamond_mesh.h"
#include "terrain/diamond_table.h"

namespace terrain {

/// Metres, relative to the terrain's anchor.
using DiamondBound = lod::ErrorSphere;

/// Makes bounds on the fly, from a record and eight bytes of the table; nothing is stored per diamond.
class BoundMaker {
  public:
    explicit BoundMaker(const DiamondTable& table);

    const glm::dvec3& anchor_world() const { return anchor_; }

    /// Cost: about 10 ns.
    DiamondBound operator()(const Diamond& d, const DiamondSource& source) const {
        const GridPoint p = domain_.clamped(d.centre());
        const double height = double(source.height_m);
        const glm::dvec3 at =
            (is_planar_ ? glm::dvec3(column_m_ * double(p.x) + row_m_ * double(p.y) + origin_m_, height)
                        : frame_.world_from_sample(p.x, p.y, height)) -
            anchor_;
        DiamondBound bound;
        bound.centre = glm::vec3(at);
        bound.error_m = source.error_m();
        const float rise = source.rise_m();
        const float reach = reach_m_[d.level];
        const float rounding =
            (std::abs(bound.centre.x) + std::abs(bound.centre.y) + std::abs(bound.centre.z)) * 0x1p-22f;
        bound.radius_m =
            (std::sqrt(reach * reach + rise * rise) + bound.error_m + rounding) * (1.0f + 0x1p-20f);
        return bound;
    }

  private:
    data::GroundFrame frame_;
    Domain domain_;
    glm::dvec3 anchor_{0.0};
    bool is_planar_ = false;  ///< then a sample lies at origin + column * x + row * y, to a nanometre
    glm::dvec2 origin_m_{0.0}, column_m_{0.0}, row_m_{0.0};
    std::vector<float> reach_m_;  ///< [level] centre to corner, horizontally, upper bound
};

}  // namespace terrain
