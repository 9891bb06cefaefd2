#include "objects/building_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lod/base/rng.h"

namespace objects {

namespace {

using Palette = std::array<glm::u8vec3, 8>;

constexpr double kTallM = 18.0;  // from here on roofs are flat and walls are those of the modern town

const Palette kLowWalls{glm::u8vec3(228, 217, 196), glm::u8vec3(216, 199, 168), glm::u8vec3(235, 229, 216),
                        glm::u8vec3(206, 184, 158), glm::u8vec3(198, 150, 126), glm::u8vec3(208, 168, 142),
                        glm::u8vec3(205, 201, 190), glm::u8vec3(222, 205, 182)};
const Palette kTallWalls{glm::u8vec3(196, 194, 188), glm::u8vec3(176, 178, 180), glm::u8vec3(212, 206, 194),
                         glm::u8vec3(164, 168, 172), glm::u8vec3(184, 168, 150), glm::u8vec3(202, 202, 204),
                         glm::u8vec3(190, 158, 138), glm::u8vec3(220, 216, 206)};
const Palette kLowRoofs{glm::u8vec3(170, 108, 84),  glm::u8vec3(180, 120, 94),  glm::u8vec3(156, 100, 80),
                        glm::u8vec3(188, 132, 102), glm::u8vec3(122, 120, 120), glm::u8vec3(108, 108, 112),
                        glm::u8vec3(148, 106, 86),  glm::u8vec3(162, 112, 88)};
const Palette kFlatRoofs{glm::u8vec3(150, 148, 144), glm::u8vec3(132, 132, 132), glm::u8vec3(168, 164, 156),
                         glm::u8vec3(120, 122, 124), glm::u8vec3(158, 152, 142), glm::u8vec3(142, 140, 138),
                         glm::u8vec3(176, 172, 166), glm::u8vec3(126, 124, 122)};

glm::u8vec3 scaled(const glm::u8vec3& colour, double factor) {
    const auto channel = [factor](uint8_t value) {
        return static_cast<uint8_t>(std::clamp(std::lround(value * factor), 0l, 255l));
    };
    return {channel(colour.x), channel(colour.y), channel(colour.z)};
}

glm::u8vec3 pick(const Palette& palette, lod::Rng& rng) {
    const glm::u8vec3 base = palette[rng.below(palette.size())];
    return scaled(base, rng.between(0.93, 1.05));
}

}  // namespace

BuildingColours building_colours(uint64_t seed, int64_t building_id, double height_m) {
    lod::Rng rng(lod::hash_combine(seed, static_cast<uint64_t>(building_id)));
    const bool is_tall = height_m >= kTallM;
    BuildingColours colours;
    colours.wall = pick(is_tall ? kTallWalls : kLowWalls, rng);
    colours.roof = pick(is_tall ? kFlatRoofs : kLowRoofs, rng);
    colours.foot = scaled(colours.wall, 0.78);
    colours.underside = scaled(colours.wall, 0.6);
    return colours;
}

}  // namespace objects
