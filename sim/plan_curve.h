// PlanCurve: one smooth curve through waypoints, measured along its length in metres.
//
// In plan a natural cubic spline over the chord lengths (twice continuously differentiable, so the turn rate of
// a craft on it has no steps); in height a monotone cubic, which never leaves the heights of its two waypoints.
// Both live in a flat sheet around the first waypoint: metres east and north along parallel and meridian.
// Source of the monotone slopes: Fritsch, Butland, A method for constructing local monotone piecewise cubic
// interpolants (1984).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "data/world_frame.h"

namespace sim {

/// Where the curve is and how it bends, after some metres.
struct CurvePoint {
    data::SitePoint site;
    double heading_rad = 0.0;            ///< clockwise from north, (-pi, pi]
    double curvature_right_per_m = 0.0;  ///< > 0: turns right
    double climb = 0.0;                  ///< metres up per metre in plan
};

/// Immutable once made.
class PlanCurve {
  public:
    /// @param waypoints  at least two; neighbours at one place are taken as one. All at one place: length 0.
    PlanCurve(std::span<const data::SitePoint> waypoints, const data::WorldFrame& frame);

    /// Metres in plan, at height 0 of the datum.
    double length_m() const { return length_at_.back(); }

    /// The curve after `distance_m`, clamped to its ends. Cost: a binary search.
    CurvePoint at(double distance_m) const;

  private:
    struct Axis {
        std::vector<double> value, slope;  ///< at the knots; a cubic Hermite between
    };
    glm::dvec3 axes_at(size_t segment, double u, int derivative) const;
    void measure();

    data::WorldFrame frame_;
    data::SitePoint origin_;
    std::vector<double> knot_;  ///< parameter: metres of chord
    Axis east_, north_, height_;
    std::vector<double> length_at_;  ///< metres of curve, kPieces per segment and the end
};

}  // namespace sim
