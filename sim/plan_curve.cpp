#include "sim/plan_curve.h"

#include <algorithm>
#include <cmath>

#include "lod/base/check.h"
#include "sim/site_metres.h"

namespace sim {
namespace {

constexpr size_t kPieces = 64;  // table entries a segment

/// Slopes of the natural cubic spline: a tridiagonal system, solved by elimination.
std::vector<double> natural_slopes(std::span<const double> knot, std::span<const double> value) {
    const size_t n = knot.size();
    std::vector<double> diagonal(n), above(n), right(n), slope(n);
    for (size_t i = 0; i < n; ++i) {
        const double h0 = i > 0 ? knot[i] - knot[i - 1] : 0.0;
        const double h1 = i + 1 < n ? knot[i + 1] - knot[i] : 0.0;
        const double a = h0 > 0.0 ? 1.0 / h0 : 0.0, b = h1 > 0.0 ? 1.0 / h1 : 0.0;
        diagonal[i] = 2.0 * (a + b);
        above[i] = b;
        right[i] = 0.0;
        if (i > 0) right[i] += 3.0 * (value[i] - value[i - 1]) * a * a;
        if (i + 1 < n) right[i] += 3.0 * (value[i + 1] - value[i]) * b * b;
        if (i > 0) {
            const double factor = a / diagonal[i - 1];
            diagonal[i] -= factor * above[i - 1];
            right[i] -= factor * right[i - 1];
        }
    }
    for (size_t i = n; i-- > 0;)
        slope[i] = (right[i] - (i + 1 < n ? above[i] * slope[i + 1] : 0.0)) / diagonal[i];
    return slope;
}

/// Slopes that keep each segment between its ends: the weighted harmonic mean, 0 at an extremum and at the ends.
std::vector<double> monotone_slopes(std::span<const double> knot, std::span<const double> value) {
    const size_t n = knot.size();
    std::vector<double> slope(n, 0.0);
    for (size_t i = 1; i + 1 < n; ++i) {
        const double h0 = knot[i] - knot[i - 1], h1 = knot[i + 1] - knot[i];
        const double d0 = (value[i] - value[i - 1]) / h0, d1 = (value[i + 1] - value[i]) / h1;
        if (d0 * d1 <= 0.0) continue;
        const double w0 = (2.0 * h1 + h0), w1 = (h1 + 2.0 * h0);
        slope[i] = (w0 + w1) / (w0 / d0 + w1 / d1);
    }
    if (n == 2) slope[0] = slope[1] = (value[1] - value[0]) / (knot[1] - knot[0]);
    return slope;
}

/// Value (0), first or second derivative of one Hermite segment, by the parameter.
double hermite(double h, double u, glm::dvec2 value, glm::dvec2 slope, int derivative) {
    const double t = u / h;
    const double rise = value.y - value.x;
    const double a = slope.x * h - rise, b = rise - slope.y * h;  // value + t rise + t(1-t)((1-t)a + t b)
    switch (derivative) {
        case 0:
            return value.x + t * rise + t * (1.0 - t) * ((1.0 - t) * a + t * b);
        case 1:
            return (rise + (1.0 - 4.0 * t + 3.0 * t * t) * a + (2.0 * t - 3.0 * t * t) * b) / h;
        default:
            return ((6.0 * t - 4.0) * a + (2.0 - 6.0 * t) * b) / (h * h);
    }
}

}  // namespace

PlanCurve::PlanCurve(std::span<const data::SitePoint> waypoints, const data::WorldFrame& frame)
    : frame_(frame) {
    CHECK(!waypoints.empty());
    origin_ = waypoints.front();
    const glm::dvec2 unit = metres_per_unit(frame_, origin_);
    for (const data::SitePoint& point : waypoints) {
        double dx = point.x - origin_.x;
        if (frame_.has_datum) dx = std::remainder(dx, 360.0);
        const double east = dx * unit.x, north = (point.y - origin_.y) * unit.y;
        double knot = 0.0;
        if (!knot_.empty()) {
            const double chord = std::hypot(east - east_.value.back(), north - north_.value.back());
            if (chord < 1e-3) continue;
            knot = knot_.back() + chord;
        }
        knot_.push_back(knot);
        east_.value.push_back(east);
        north_.value.push_back(north);
        height_.value.push_back(point.height_m);
    }
    if (knot_.size() > 1) {
        east_.slope = natural_slopes(knot_, east_.value);
        north_.slope = natural_slopes(knot_, north_.value);
        height_.slope = monotone_slopes(knot_, height_.value);
    }
    measure();
}

glm::dvec3 PlanCurve::axes_at(size_t segment, double u, int derivative) const {
    const double h = knot_[segment + 1] - knot_[segment];
    const auto one = [&](const Axis& axis) {
        return hermite(h, u, {axis.value[segment], axis.value[segment + 1]},
                       {axis.slope[segment], axis.slope[segment + 1]}, derivative);
    };
    return {one(east_), one(north_), one(height_)};
}

void PlanCurve::measure() {
    length_at_.assign(1, 0.0);
    for (size_t segment = 0; segment + 1 < knot_.size(); ++segment) {
        const double step = (knot_[segment + 1] - knot_[segment]) / kPieces;
        for (size_t piece = 0; piece < kPieces; ++piece) {
            // Simpson's rule over the speed: exact enough that the table's own interpolation is what remains.
            const double u = static_cast<double>(piece) * step;
            const auto speed = [&](double at) { return glm::length(glm::dvec2(axes_at(segment, at, 1))); };
            const double metres = step / 6.0 * (speed(u) + 4.0 * speed(u + step / 2.0) + speed(u + step));
            length_at_.push_back(length_at_.back() + metres);
        }
    }
}

CurvePoint PlanCurve::at(double distance_m) const {
    CurvePoint point;
    if (knot_.size() < 2) {
        point.site = origin_;
        return point;
    }
    const double distance = std::clamp(distance_m, 0.0, length_m());
    const auto next = std::upper_bound(length_at_.begin(), length_at_.end() - 1, distance);
    const size_t entry = static_cast<size_t>(next - length_at_.begin()) - 1;
    const size_t segment = entry / kPieces;
    const double step = (knot_[segment + 1] - knot_[segment]) / kPieces;
    const double start_u = static_cast<double>(entry % kPieces) * step;
    double u = start_u + step * (distance - length_at_[entry]) / (length_at_[entry + 1] - length_at_[entry]);
    for (int pass = 0; pass < 2; ++pass) {  // Newton: the distance is metres of curve, u is metres of chord
        const double half = (start_u + u) / 2.0;
        const auto speed = [&](double x) { return glm::length(glm::dvec2(axes_at(segment, x, 1))); };
        const double metres = (u - start_u) / 6.0 * (speed(start_u) + 4.0 * speed(half) + speed(u));
        u += (distance - length_at_[entry] - metres) / std::max(speed(u), 1e-9);
    }
    const glm::dvec3 p = axes_at(segment, u, 0), d = axes_at(segment, u, 1), dd = axes_at(segment, u, 2);
    const double speed = std::max(glm::length(glm::dvec2(d)), 1e-9);
    point.site = moved(frame_, origin_, {p.x, p.y});
    point.site.height_m = p.z;
    point.heading_rad = std::atan2(d.x, d.y);
    point.curvature_right_per_m = (d.y * dd.x - d.x * dd.y) / (speed * speed * speed);
    point.climb = d.z / speed;
    return point;
}

}  // namespace sim
