#include "data/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string_view>

#include "data/file_bytes.h"
#include "data/motion_attitude.h"
#include "data/motion_csv.h"
#include "data/motion_gpx.h"

namespace data {

namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr size_t kMaxSize_bytes = size_t{1} << 30;

lod::Result<MotionFixes> read_fixes(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".gpx" || extension == ".GPX") return read_motion_gpx(path);
    const lod::Result<std::vector<uint8_t>> bytes = read_file(path, kMaxSize_bytes);
    if (!bytes) return bytes.error();
    return read_motion_csv({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

double wrapped_heading(double heading_rad) {
    const double rest = std::fmod(heading_rad, kTurn_rad);
    return rest < 0.0 ? rest + kTurn_rad : rest;
}

double wrapped_longitude(double degrees) {
    return std::remainder(degrees, 360.0);
}

/// Copies an angle of the fixes where any of them records it, gaps taking the value before (at the start, after)
/// them. @returns whether it was recorded
bool take_recorded(const std::vector<MotionFix>& fixes, double MotionFix::*from, double MotionSample::*to,
                   std::vector<MotionSample>& samples) {
    const auto is_recorded = [from](const MotionFix& fix) { return std::isfinite(fix.*from); };
    const auto first = std::find_if(fixes.begin(), fixes.end(), is_recorded);
    if (first == fixes.end()) return false;
    double value = (*first).*from;
    for (size_t i = 0; i < fixes.size(); ++i) {
        if (is_recorded(fixes[i])) value = fixes[i].*from;
        samples[i].*to = value;
    }
    return true;
}

/// Attitude as recorded, angle by angle, else derived from the path.
void complete_attitude(const MotionFixes& recorded, Motion& motion) {
    const std::vector<Attitude> derived = derive_attitude(recorded);
    for (size_t i = 0; i < derived.size(); ++i) {
        motion.samples[i].heading_rad = derived[i].heading_rad;
        motion.samples[i].pitch_rad = derived[i].pitch_rad;
        motion.samples[i].roll_rad = derived[i].roll_rad;
    }
    const std::vector<MotionFix>& fixes = recorded.fixes;
    take_recorded(fixes, &MotionFix::heading_rad, &MotionSample::heading_rad, motion.samples);
    const bool has_pitch =
        take_recorded(fixes, &MotionFix::pitch_rad, &MotionSample::pitch_rad, motion.samples);
    const bool has_roll = take_recorded(fixes, &MotionFix::roll_rad, &MotionSample::roll_rad, motion.samples);
    motion.has_attitude = has_pitch && has_roll;
    for (MotionSample& sample : motion.samples)
        sample.heading_rad = wrapped_heading(sample.heading_rad);
}

/// Position and attitude as one vector to interpolate: x, y, height, heading, pitch, roll.
using Pose = std::array<double, 6>;

/// From sample a to sample b: longitudes and angles the short way round.
Pose way(const Motion& motion, size_t a, size_t b) {
    const MotionSample &from = motion.samples[a], &to = motion.samples[b];
    const double x = to.site.x - from.site.x;
    return {motion.is_geographic ? std::remainder(x, 360.0) : x,
            to.site.y - from.site.y,
            to.site.height_m - from.site.height_m,
            std::remainder(to.heading_rad - from.heading_rad, kTurn_rad),
            std::remainder(to.pitch_rad - from.pitch_rad, kTurn_rad),
            std::remainder(to.roll_rad - from.roll_rad, kTurn_rad)};
}

double step_s(const Motion& motion, size_t i) {
    return motion.samples[i + 1].time_s - motion.samples[i].time_s;
}

/// Metres a second of a place's rate of change near a latitude.
double speed_mps(const Motion& motion, const Pose& rate, double latitude_deg) {
    if (!motion.is_geographic) return std::hypot(rate[0], rate[1], rate[2]);
    constexpr double kMetresPerDegree = 111'195.0;
    const double shrink = std::cos(latitude_deg * std::numbers::pi / 180.0);
    return std::hypot(rate[0] * kMetresPerDegree * shrink, rate[1] * kMetresPerDegree, rate[2]);
}

/// No rate is more than twice the lesser of its neighbours': no overshoot beyond a stop, no loops at uneven steps.
double limit(double rate, double before, double after) {
    const double allowed = 2.0 * std::min(before, after);
    return rate > allowed ? allowed / rate : 1.0;
}

/// Rate of change at sample i, a second: of the parabola through it and its neighbours (Catmull-Rom over time).
Pose rate_at(const Motion& motion, size_t i) {
    const size_t last = motion.samples.size() - 1;
    const double before_s = i > 0 ? step_s(motion, i - 1) : 0.0, after_s = i < last ? step_s(motion, i) : 0.0;
    Pose before{}, after{}, rate{};
    if (i > 0) before = way(motion, i - 1, i);
    if (i < last) after = way(motion, i, i + 1);
    for (size_t k = 0; k < rate.size(); ++k) {
        before[k] = i > 0 ? before[k] / before_s : after[k] / after_s;
        after[k] = i < last ? after[k] / after_s : before[k];
        rate[k] = (before[k] * after_s + after[k] * before_s) / (before_s + after_s);
    }
    const double latitude = motion.samples[i].site.y;
    const double place = limit(speed_mps(motion, rate, latitude), speed_mps(motion, before, latitude),
                               speed_mps(motion, after, latitude));
    for (size_t k = 0; k < rate.size(); ++k)
        rate[k] *= k < 3 ? place : limit(std::abs(rate[k]), std::abs(before[k]), std::abs(after[k]));
    return rate;
}

}  // namespace

lod::Result<Motion> read_motion(const std::string& path) {
    const lod::Result<MotionFixes> recorded = read_fixes(path);
    if (!recorded) return recorded.error();
    const std::vector<MotionFix>& fixes = recorded->fixes;
    if (fixes.size() < 2) {
        return lod::Error{path + ": " + std::to_string(fixes.size()) + " usable rows of " +
                          std::to_string(fixes.size() + recorded->dropped) +
                          "; expected two or more whole lines with time, place and height"};
    }
    Motion motion;
    motion.is_geographic = recorded->is_geographic;
    motion.dropped = recorded->dropped;
    for (const MotionFix& fix : fixes) {
        MotionSample sample;
        sample.time_s = fix.time_s - fixes[0].time_s;
        sample.site = fix.site;
        motion.samples.push_back(sample);
    }
    complete_attitude(*recorded, motion);
    return motion;
}

MotionSample motion_at(const Motion& motion, double time_s) {
    CHECK(motion.samples.size() >= 2);
    if (!(time_s > 0.0)) return motion.samples.front();
    if (time_s >= motion.duration_s()) return motion.samples.back();
    const auto after =
        std::upper_bound(motion.samples.begin(), motion.samples.end(), time_s,
                         [](double t, const MotionSample& sample) { return t < sample.time_s; });
    const size_t i = static_cast<size_t>(after - motion.samples.begin()) - 1;
    const MotionSample& from = motion.samples[i];
    const double step = step_s(motion, i), u = (time_s - from.time_s) / step;
    const Pose whole = way(motion, i, i + 1), begin = rate_at(motion, i), end = rate_at(motion, i + 1);
    // Hermite's basis without the term of the start, which is the origin here.
    const double to_begin = step * u * (1.0 - u) * (1.0 - u), to_end = -step * u * u * (1.0 - u),
                 to_whole = u * u * (3.0 - 2.0 * u);
    Pose moved;
    for (size_t k = 0; k < moved.size(); ++k)
        moved[k] = to_whole * whole[k] + to_begin * begin[k] + to_end * end[k];

    const double x = from.site.x + moved[0];
    MotionSample sample;
    sample.time_s = time_s;
    sample.site = {motion.is_geographic ? wrapped_longitude(x) : x, from.site.y + moved[1],
                   from.site.height_m + moved[2]};
    sample.heading_rad = wrapped_heading(from.heading_rad + moved[3]);
    sample.pitch_rad = from.pitch_rad + moved[4];
    sample.roll_rad = from.roll_rad + moved[5];
    return sample;
}

}  // namespace data
