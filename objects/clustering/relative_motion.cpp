#include "objects/clustering/relative_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "data/scene_time.h"

namespace objects {

namespace {

constexpr double kRounding_m = 1e-6;
constexpr double kBulgeShare =
    1.0 / 32.0;                     ///< of what is asked: an arc between two samples bulges no farther …
constexpr int kMostPieces = 64;     ///< … unless that takes more pieces
constexpr double kGrid = 262144.0;  ///< steps of a place a metre, and of its rotation

/// The member's frame seen from the carrier.
struct Relative {
    glm::dquat rotation;
    glm::dvec3 offset;
};

Relative relative_at(const MovingPair& pair, double time_s) {
    const data::ObjectPose carrier = data::pose_between(pair.carrier, time_s),
                           member = data::pose_between(pair.member, time_s);
    const glm::dquat back = glm::conjugate(carrier.rotation);
    return {back * member.rotation, back * (member.position - carrier.position)};
}

bool is_there(const MovingPair& pair, double time_s) {
    const StepFunction& f = *pair.presence;
    const auto after = std::upper_bound(f.time_s.begin() + 1, f.time_s.end(), time_s);
    return f.value[static_cast<size_t>(after - f.time_s.begin()) - 1] > 0.0;
}

/// From one instant of interest to the next; both are the same at the end of time.
struct Stretch {
    double begin_s, end_s;
};

/// The time while the member is there, cut at the key frames of both.
std::vector<Stretch> stretches_of(const MovingPair& pair) {
    std::vector<double> cuts = {0.0, pair.end_s};
    const auto add = [&](double time_s) {
        if (time_s > 0.0 && time_s < pair.end_s) cuts.push_back(time_s);
    };
    for (const auto& keys : {pair.carrier, pair.member}) {
        for (const data::KeyFrame& key : keys)
            add(key.time_s);
    }
    std::for_each(pair.presence->time_s.begin(), pair.presence->time_s.end(), add);
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    std::vector<Stretch> stretches;
    for (size_t i = 0; i < cuts.size(); ++i) {
        if (is_there(pair, cuts[i])) stretches.push_back({cuts[i], cuts[std::min(i + 1, cuts.size() - 1)]});
    }
    return stretches;
}

std::array<glm::dvec3, 8> corners_of(const MovingPair& pair) {
    std::array<glm::dvec3, 8> corners;
    for (size_t i = 0; i < corners.size(); ++i) {
        corners[i] = {(i & 1) != 0 ? pair.box_max.x : pair.box_min.x,
                      (i & 2) != 0 ? pair.box_max.y : pair.box_min.y,
                      (i & 4) != 0 ? pair.box_max.z : pair.box_min.z};
    }
    return corners;
}

/// Between 0 and pi.
double angle_between_rad(const glm::dquat& a, const glm::dquat& b) {
    return 2.0 * std::acos(std::min(std::abs(glm::dot(a, b)), 1.0));
}

/// What bounds the second derivative of any corner's way over a stretch, times its length squared: metres.
double bend_m(const MovingPair& pair, const Stretch& stretch, double member_arm_m, double carrier_arm_m) {
    const auto turn_rad = [&](std::span<const data::KeyFrame> keys) {
        return angle_between_rad(data::pose_between(keys, stretch.begin_s).rotation,
                                 data::pose_between(keys, stretch.end_s).rotation);
    };
    const double member_rad = turn_rad(pair.member), carrier_rad = turn_rad(pair.carrier);
    return member_rad * member_rad * member_arm_m + carrier_rad * carrier_rad * carrier_arm_m;
}

double on_grid(double value) {
    return std::round(value * kGrid) / kGrid;
}

}  // namespace

bool surely_strays(const MovingPair& pair, double most_m) {
    constexpr size_t kSamples = 8;
    const glm::dvec3 middle = 0.5 * (pair.box_min + pair.box_max);
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (size_t i = 0; i < kSamples; ++i) {
        const double time_s =
            std::clamp(pair.member[i * (pair.member.size() - 1) / (kSamples - 1)].time_s, 0.0, pair.end_s);
        if (!is_there(pair, time_s)) continue;
        const Relative seen = relative_at(pair, time_s);
        low = glm::min(low, seen.rotation * middle + seen.offset);
        high = glm::max(high, seen.rotation * middle + seen.offset);
        if (glm::any(glm::greaterThan(high - low, glm::dvec3(2.0 * (most_m + kRounding_m))))) return true;
    }
    return false;
}

FramePlace middle_place(const MovingPair& pair) {
    const glm::dvec3 middle = 0.5 * (pair.box_min + pair.box_max);
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    glm::dquat sum(0.0, 0.0, 0.0, 0.0);
    for (const Stretch& stretch : stretches_of(pair)) {
        for (const double time_s : {stretch.begin_s, 0.5 * (stretch.begin_s + stretch.end_s)}) {
            const Relative seen = relative_at(pair, time_s);
            low = glm::min(low, seen.rotation * middle + seen.offset);
            high = glm::max(high, seen.rotation * middle + seen.offset);
            sum += glm::dot(sum, seen.rotation) < 0.0 ? -seen.rotation : seen.rotation;
        }
    }
    const double length = glm::length(sum);
    if (!(length > 0.0)) return {};  // never there
    sum /= length;
    const glm::dquat rotation =
        glm::normalize(glm::dquat(on_grid(sum.w), on_grid(sum.x), on_grid(sum.y), on_grid(sum.z)));
    const glm::dvec3 offset = 0.5 * (low + high) - rotation * middle;
    return {glm::mat3_cast(rotation), {on_grid(offset.x), on_grid(offset.y), on_grid(offset.z)}};
}

double drift_m(const MovingPair& pair, const FramePlace& place, double most_m) {
    const std::array<glm::dvec3, 8> corners = corners_of(pair);
    double member_arm_m = 0.0, carrier_arm_m = 0.0, largest_m = 0.0;
    for (const glm::dvec3& corner : corners) {
        member_arm_m = std::max(member_arm_m, glm::length(corner));
        carrier_arm_m = std::max(carrier_arm_m, glm::length(place.rotation * corner + place.offset));
    }
    for (const Stretch& stretch : stretches_of(pair)) {
        const double bend = bend_m(pair, stretch, member_arm_m, carrier_arm_m);
        const double wanted = std::sqrt(bend / (8.0 * kBulgeShare * most_m));
        const int pieces = wanted < kMostPieces ? 1 + static_cast<int>(wanted) : kMostPieces;
        const double bulge_m = bend / (8.0 * pieces * pieces);
        for (int i = 0; i <= pieces; ++i) {
            const Relative seen =
                relative_at(pair, stretch.begin_s + (stretch.end_s - stretch.begin_s) * (double(i) / pieces));
            const glm::dmat3 turned = glm::mat3_cast(seen.rotation) - place.rotation;
            for (const glm::dvec3& corner : corners)
                largest_m = std::max(largest_m,
                                     glm::length(turned * corner + (seen.offset - place.offset)) + bulge_m);
            if (largest_m + kRounding_m > most_m) return std::numeric_limits<double>::infinity();
        }
    }
    return largest_m + kRounding_m;
}

}  // namespace objects
