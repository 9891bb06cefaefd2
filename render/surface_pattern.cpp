#include "render/surface_pattern.h"

#include <algorithm>
#include <array>

#include "render/tiling_noise.h"

namespace render {

namespace {

constexpr int kBays = 8, kStoreys = 8;

/// A window in its bay of 1 x 1, measured from the left and from the upper edge of the storey.
struct Facade {
    glm::vec2 low{0.3f, 0.25f}, high{0.7f, 0.72f};
    float frame = 0.035f;  ///< width of the frame
    glm::vec3 frame_factor{1.1f};
    float shutter = 0.0f;  ///< width of the shutters on both sides
    glm::vec3 shutter_factor{1.0f};
    float course = 0.0f;    ///< height of a lighter band between the storeys
    float mullions = 2.0f;  ///< panes side by side
};

const std::array<Facade, 3> kFacades{
    Facade{{0.33f, 0.27f}, {0.67f, 0.75f}, 0.03f, glm::vec3(1.12f), 0.13f, {0.50f, 0.60f, 0.55f}, 0.0f, 2.0f},
    Facade{{0.24f, 0.25f}, {0.76f, 0.74f}, 0.03f, glm::vec3(1.10f), 0.0f, glm::vec3(1.0f), 0.06f, 3.0f},
    Facade{{0.0f, 0.22f}, {1.0f, 0.80f}, 0.03f, glm::vec3(0.80f), 0.0f, glm::vec3(1.0f), 0.03f, 2.0f},
};

/// What one sees in a pane: a dark room, a curtain, or the sky.
glm::vec3 pane_factor(uint32_t bay, uint32_t storey, float height) {
    const float kind = lattice_value(bay, storey, 5), shade = lattice_value(bay, storey, 6);
    if (kind < 0.22f) return glm::vec3(0.72f, 0.70f, 0.66f) * (0.85f + 0.2f * shade);
    return glm::mix(glm::vec3(0.24f, 0.28f, 0.33f), glm::vec3(0.42f, 0.50f, 0.58f), height) *
           (0.75f + 0.5f * shade);
}

bool is_within(const glm::vec2& p, const glm::vec2& low, const glm::vec2& high) {
    return p.x >= low.x && p.x < high.x && p.y >= low.y && p.y < high.y;
}

glm::vec3 facade_factor(const Facade& facade, const glm::vec2& p) {
    const glm::vec2 scaled(p.x * kBays, (1.0f - p.y) * kStoreys), cell = glm::floor(scaled);
    const glm::vec2 at = scaled - cell;
    const glm::vec2 low = facade.low, high = facade.high;
    if (is_within(at, low, high)) {
        const float pane = (at.x - low.x) / (high.x - low.x) * facade.mullions;
        const float across = std::abs(pane - std::round(pane)) * (high.x - low.x) / facade.mullions;
        const float down = std::min(at.y - low.y, high.y - at.y);
        if (std::min(across, down) < facade.frame / 2.0f) return facade.frame_factor;
        const float height = 1.0f - (at.y - low.y) / (high.y - low.y);
        return pane_factor(static_cast<uint32_t>(cell.x), static_cast<uint32_t>(cell.y), height);
    }
    const glm::vec2 aside(facade.shutter, 0.0f);
    if (is_within(at, low - aside, high + aside)) return facade.shutter_factor;
    if (at.y < facade.course || at.y > 1.0f - facade.course / 2.0f) return glm::vec3(1.12f);
    const float sill = high.y + 0.03f;
    if (at.y >= high.y && at.y < sill && at.x >= low.x && at.x < high.x) return glm::vec3(0.82f);
    const float stain = tiling_octaves(p, {6, 5, 0.7f}, 21);
    return glm::vec3(1.04f + 0.035f * stain);
}

/// Heights of tufts and clods, about [-1, 1].
float ground_height(const glm::vec2& p) {
    return 0.6f * tiling_octaves(p, {20, 5, 0.72f}, 1);
}

glm::vec3 ground_factor(const glm::vec2& p, const glm::vec2& towards_sun) {
    constexpr float kStep = 0.75f / kPatternSide_px;
    const float height = ground_height(p);
    const float sunward = ground_height(glm::fract(p + towards_sun * kStep));
    const float patches = tiling_octaves(p, {7, 3, 0.6f}, 11);
    const float dry = tiling_octaves(p, {11, 4, 0.7f}, 31);
    const float light = 1.0f + 0.12f * height + 0.08f * patches + 0.85f * (height - sunward);
    return glm::vec3(1.0f + 0.035f * dry, 1.0f, 1.0f - 0.045f * dry) * light;
}

glm::vec3 roof_factor(const glm::vec2& p) {
    const float fine = tiling_octaves(p, {48, 3, 0.8f}, 41), broad = tiling_octaves(p, {5, 3, 0.6f}, 51);
    return glm::vec3(1.0f + 0.07f * fine + 0.07f * broad);
}

glm::vec3 factor_at(Pattern pattern, const glm::vec2& p, const glm::vec2& towards_sun) {
    switch (pattern) {
        case Pattern::kPlain:
            return glm::vec3(1.0f);
        case Pattern::kGround:
            return ground_factor(p, towards_sun);
        case Pattern::kRoof:
            return roof_factor(p);
        case Pattern::kHouse:
        case Pattern::kFlats:
        case Pattern::kOffice:
            break;
    }
    return facade_factor(kFacades[static_cast<size_t>(pattern) - static_cast<size_t>(Pattern::kHouse)], p);
}

/// Scales each channel so that the mean over all texels is the factor 1.
void make_neutral(std::vector<glm::vec3>& factors) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& factor : factors)
        sum += glm::dvec3(factor);
    const glm::vec3 to_neutral(static_cast<double>(factors.size()) / sum);
    for (glm::vec3& factor : factors)
        factor *= to_neutral;
}

}  // namespace

std::vector<glm::vec3> paint_pattern(Pattern pattern, const glm::vec3& sun_enu) {
    const glm::vec2 level(sun_enu.x, sun_enu.y);
    const float slant = glm::length(level);
    const glm::vec2 towards_sun = slant > 1e-6f ? glm::vec2(level.x, -level.y) / slant : glm::vec2(0.0f);
    std::vector<glm::vec3> factors(size_t{kPatternSide_px} * kPatternSide_px);
    for (size_t i = 0; i < factors.size(); ++i) {
        const glm::vec2 texel(i % kPatternSide_px, i / kPatternSide_px);
        factors[i] = factor_at(pattern, (texel + 0.5f) / static_cast<float>(kPatternSide_px), towards_sun);
    }
    if (pattern == Pattern::kGround || pattern == Pattern::kRoof) make_neutral(factors);
    return factors;
}

std::vector<glm::vec3> halved(const std::vector<glm::vec3>& factors, int side_px) {
    const auto side = static_cast<size_t>(side_px);
    std::vector<glm::vec3> half;
    half.reserve(factors.size() / 4);
    for (size_t y = 0; y + 1 < side; y += 2) {
        for (size_t x = 0; x + 1 < side; x += 2) {
            const glm::vec3* f = &factors[y * side + x];
            half.push_back(0.25f * (f[0] + f[1] + f[side] + f[side + 1]));
        }
    }
    return half;
}

std::vector<uint8_t> encode_factors(const std::vector<glm::vec3>& factors) {
    std::vector<uint8_t> rgba;
    rgba.reserve(4 * factors.size());
    for (const glm::vec3& factor : factors) {
        const glm::vec3 value = glm::clamp(factor * float{kNeutral} + 0.5f, 0.0f, 255.0f);
        for (int i = 0; i < 3; ++i)
            rgba.push_back(static_cast<uint8_t>(value[i]));
        rgba.push_back(255);
    }
    return rgba;
}

}  // namespace render
