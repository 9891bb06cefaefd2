#include "data/scenes/site_route.h"

#include <cmath>

#include "lod/base/check.h"

namespace data::site {

namespace {

/// The turn that points +y along `way`.
double turn_along(const glm::dvec2& way) {
    return std::atan2(-way.x, way.y);
}

}  // namespace

double append_drive(std::span<const glm::dvec2> way, const Drive& drive, std::vector<KeyFrame>& keys) {
    CHECK(way.size() >= 2);
    double time_s = drive.begins_s;
    glm::dvec2 here = way[0];
    const auto go_to = [&](const glm::dvec2& place, double turn_rad) {
        time_s += glm::distance(here, place) / drive.speed_mps;
        here = place;
        keys.push_back(key_at(time_s, {{place, 0.0}, turn_rad}));
    };
    for (size_t i = 1; i < way.size(); ++i) {
        const glm::dvec2 ahead = glm::normalize(way[i] - way[i - 1]);
        const double turn_rad = turn_along(ahead);
        go_to(i == 1 ? way[0] : way[i - 1] + ahead * drive.turn_m, turn_rad);
        const bool is_last = i + 1 == way.size();
        go_to(is_last ? way[i] : way[i] - ahead * drive.turn_m, turn_rad);
    }
    return time_s;
}

std::vector<KeyFrame> carried(std::span<const KeyFrame> keys, const Placement& in_carrier) {
    const KeyFrame inner = key_at(0.0, in_carrier);
    std::vector<KeyFrame> result(keys.begin(), keys.end());
    for (KeyFrame& key : result) {
        key.position += key.rotation * inner.position;
        key.rotation = key.rotation * inner.rotation;
    }
    return result;
}

}  // namespace data::site
