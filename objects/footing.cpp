#include "objects/footing.h"

#include <algorithm>
#include <cmath>

#include "data/ground_height.h"

namespace objects {

namespace {

glm::dvec2 plane_from_site(const Ground& ground, const glm::dvec2& site) {
    return ground.grid == nullptr ? site : ground.grid->frame.grid_from_site({site.x, site.y, 0.0});
}

bool append_foot(const Ground& ground, const glm::dvec2& plane, Footing& out) {
    data::GroundHeight found{0.0, true};
    if (ground.grid != nullptr) found = data::ground_height(*ground.grid, plane.x, plane.y);
    out.feet.push_back({plane, found.height_m});
    return found.valid;
}

}  // namespace

glm::dvec3 world_at(const Ground& ground, const glm::dvec2& plane, double height_m) {
    if (ground.grid == nullptr) return ground.world.world_from_site({plane.x, plane.y, height_m});
    return ground.grid->frame.world_from_grid(plane.x, plane.y, height_m);
}

bool lay_ring(const Ground& ground, std::span<const glm::dvec2> ring, Footing& out) {
    out.feet.clear();
    out.first_foot.clear();
    std::vector<glm::dvec2> corners;
    for (const glm::dvec2& site : ring)
        corners.push_back(plane_from_site(ground, site));
    std::vector<double> crossings;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        out.first_foot.push_back(static_cast<uint32_t>(out.feet.size()));
        if (!append_foot(ground, a, out)) return false;  // corners inside bound the number of crossings
        if (ground.grid == nullptr) continue;
        if (!data::ground_height(*ground.grid, b.x, b.y).valid) return false;
        data::mesh_crossings(a, b, crossings);
        for (double fraction : crossings) {
            if (!append_foot(ground, a + (b - a) * fraction, out)) return false;
        }
    }
    out.first_foot.push_back(static_cast<uint32_t>(out.feet.size()));
    if (!out.feet.empty()) out.feet.push_back(out.feet.front());
    return !out.feet.empty();
}

GroundProfile profile_of(const Footing& footing) {
    GroundProfile profile{0.0, footing.feet[0].height_m, footing.feet[0].height_m};
    double length = 0.0;
    for (size_t i = 0; i + 1 < footing.feet.size(); ++i) {
        const Foot &a = footing.feet[i], &b = footing.feet[i + 1];
        const double step = glm::distance(a.plane, b.plane);
        profile.mean_m += step * (a.height_m + b.height_m) / 2.0;
        length += step;
        profile.lowest_m = std::min(profile.lowest_m, b.height_m);
        profile.highest_m = std::max(profile.highest_m, b.height_m);
    }
    profile.mean_m = length > 0.0 ? profile.mean_m / length : profile.lowest_m;
    return profile;
}

}  // namespace objects
