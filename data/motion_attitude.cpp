#include "data/motion_attitude.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace data {

namespace {

constexpr double kGravity_mps2 = 9.80665, kMinSpeed_mps = 1.0, kSureSpeed_mps = 5.0, kSmoothing_s = 1.5;
constexpr double kDegree_rad = std::numbers::pi / 180.0, kMaxPitch_rad = 30.0 * kDegree_rad,
                 kMaxRoll_rad = 60.0 * kDegree_rad;

/// East, north, up in metres from fix a to fix b, on a sphere.
glm::dvec3 way_m(const MotionFixes& recorded, size_t a, size_t b) {
    const SitePoint &from = recorded.fixes[a].site, &to = recorded.fixes[b].site;
    const double up = to.height_m - from.height_m;
    if (!recorded.is_geographic) return {to.x - from.x, to.y - from.y, up};
    constexpr double kMetresPerDegree = 111'195.0;
    const double shrink = std::cos(0.5 * (from.y + to.y) * kDegree_rad);
    return {std::remainder(to.x - from.x, 360.0) * kMetresPerDegree * shrink,
            (to.y - from.y) * kMetresPerDegree, up};
}

/// Velocities in m/s: of the parabola through a fix and its neighbours; straight at the ends.
std::vector<glm::dvec3> velocities(const MotionFixes& recorded) {
    const size_t count = recorded.fixes.size();
    std::vector<glm::dvec3> straight(count - 1), result(count);
    std::vector<double> step_s(count - 1);
    for (size_t i = 0; i + 1 < count; ++i) {
        step_s[i] = recorded.fixes[i + 1].time_s - recorded.fixes[i].time_s;
        straight[i] = way_m(recorded, i, i + 1) / step_s[i];
    }
    result.front() = straight.front();
    result.back() = straight.back();
    for (size_t i = 1; i + 1 < count; ++i) {
        result[i] = (straight[i - 1] * step_s[i] + straight[i] * step_s[i - 1]) / (step_s[i - 1] + step_s[i]);
    }
    return result;
}

/// Means weighted by a bell curve over time.
std::vector<double> smoothed(const MotionFixes& recorded, const std::vector<double>& values) {
    const std::vector<MotionFix>& fixes = recorded.fixes;
    std::vector<double> result(values.size());
    for (size_t i = 0, begin = 0; i < values.size(); ++i) {
        while (fixes[i].time_s - fixes[begin].time_s > 3.0 * kSmoothing_s)
            ++begin;
        double sum = 0.0, weights = 0.0;
        for (size_t j = begin; j < values.size(); ++j) {
            const double apart = (fixes[j].time_s - fixes[i].time_s) / kSmoothing_s;
            if (apart > 3.0) break;
            const double weight = std::exp(-0.5 * apart * apart);
            sum += weight * values[j];
            weights += weight;
        }
        result[i] = sum / weights;
    }
    return result;
}

/// Continuous headings, not wrapped; where it stands still the last one, at the start the first.
std::vector<double> headings(const std::vector<glm::dvec3>& velocity_mps) {
    std::vector<double> heading_rad(velocity_mps.size());
    bool is_known = false;
    for (size_t i = 0; i < velocity_mps.size(); ++i) {
        const glm::dvec3& v = velocity_mps[i];
        const double before = i == 0 ? 0.0 : heading_rad[i - 1];
        if (std::hypot(v.x, v.y) < kMinSpeed_mps) {
            heading_rad[i] = before;
            continue;
        }
        heading_rad[i] = before + std::remainder(std::atan2(v.x, v.y) - before, 2.0 * std::numbers::pi);
        if (!is_known) std::fill_n(heading_rad.begin(), i, heading_rad[i]);
        is_known = true;
    }
    return heading_rad;
}

std::vector<double> turn_rates(const MotionFixes& recorded, const std::vector<double>& heading_rad) {
    const size_t last = heading_rad.size() - 1;
    std::vector<double> rate_radps(heading_rad.size());
    for (size_t i = 0; i <= last; ++i) {
        const size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, last);
        rate_radps[i] = (heading_rad[after] - heading_rad[before]) /
                        (recorded.fixes[after].time_s - recorded.fixes[before].time_s);
    }
    return rate_radps;
}

}  // namespace

std::vector<Attitude> derive_attitude(const MotionFixes& recorded) {
    const std::vector<glm::dvec3> velocity_mps = velocities(recorded);
    const std::vector<double> heading_rad = smoothed(recorded, headings(velocity_mps));
    const std::vector<double> rate_radps = turn_rates(recorded, heading_rad);
    std::vector<double> pitch_rad(velocity_mps.size()), roll_rad(velocity_mps.size());
    for (size_t i = 0; i < velocity_mps.size(); ++i) {
        const double speed_mps = std::hypot(velocity_mps[i].x, velocity_mps[i].y);
        const double trust =
            std::clamp((speed_mps - kMinSpeed_mps) / (kSureSpeed_mps - kMinSpeed_mps), 0.0, 1.0);
        const double climb_rad = std::atan2(velocity_mps[i].z, speed_mps),
                     bank_rad = std::atan(speed_mps * rate_radps[i] / kGravity_mps2);
        pitch_rad[i] = trust * std::clamp(climb_rad, -kMaxPitch_rad, kMaxPitch_rad);
        roll_rad[i] = trust * std::clamp(bank_rad, -kMaxRoll_rad, kMaxRoll_rad);
    }
    pitch_rad = smoothed(recorded, pitch_rad);
    roll_rad = smoothed(recorded, roll_rad);
    std::vector<Attitude> attitudes;
    for (size_t i = 0; i < heading_rad.size(); ++i)
        attitudes.push_back({heading_rad[i], pitch_rad[i], roll_rad[i]});
    return attitudes;
}

}  // namespace data
