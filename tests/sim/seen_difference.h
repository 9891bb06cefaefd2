// What a human eye tells apart in two pictures, where a pixel is a minute of arc: CIELAB after the eye's own blur; and what it
// would tell apart in squares of them, which is what surfaces in the wrong light show.
//
// Pictures are drawn several times as large and averaged, or else the raster's choice of samples would be measured. Blur:
// the sharpest Gaussian of S-CIELAB, for brightness, spread 0.0283 degrees; colours, which the eye blurs more, get no
// more. A just noticeable difference is 2.3 (Mahy, Van Eycken, Oosterlinck, 1994).
// Sources: CIE 15, 1976 L*a*b*; Zhang, Wandell, A spatial extension of CIELAB for digital color image reproduction (1997).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/renderer.h"

namespace sim_test {

inline constexpr double kJustNoticeable = 2.3;  // of CIELAB

/// Linear light, row-major.
struct LightImage {
    int width = 0, height = 0;
    std::vector<glm::dvec3> light;
    const glm::dvec3& at(int x, int y) const {
        const int column = std::clamp(x, 0, width - 1), row = std::clamp(y, 0, height - 1);
        return light[static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column)];
    }
};

/// Means over squares of `factor` pixels.
inline LightImage averaged(const render::ColourImage& image, int factor) {
    std::array<double, 256> linear;
    for (size_t value = 0; value < linear.size(); ++value) {
        const double v = static_cast<double>(value) / 255.0;
        linear[value] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    LightImage out{image.width / factor, image.height / factor, {}};
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            glm::dvec3 sum(0.0);
            for (int i = 0; i < factor * factor; ++i) {
                const int row = factor * y + i / factor, column = factor * x + i % factor;
                const uint8_t* texel = &image.rgba[4 * static_cast<size_t>(row * image.width + column)];
                sum += glm::dvec3(linear[texel[0]], linear[texel[1]], linear[texel[2]]);
            }
            out.light.push_back(sum / double(factor * factor));
        }
    }
    return out;
}

inline LightImage blurred(const LightImage& image) {
    constexpr double kSpread_px = 0.0283 * 60.0;  // exp(-(x / spread)^2)
    constexpr int kReach = 4;
    LightImage now = image;
    for (const bool is_row : {true, false}) {
        const LightImage before = now;
        for (int y = 0; y < now.height; ++y) {
            for (int x = 0; x < now.width; ++x) {
                glm::dvec3 sum(0.0);
                double weights = 0.0;
                for (int i = -kReach; i <= kReach; ++i) {
                    const double weight = std::exp(-double(i * i) / (kSpread_px * kSpread_px));
                    sum += weight * (is_row ? before.at(x + i, y) : before.at(x, y + i));
                    weights += weight;
                }
                now.light[static_cast<size_t>(y * now.width + x)] = sum / weights;
            }
        }
    }
    return now;
}

/// CIELAB of linear sRGB, white D65.
inline glm::dvec3 lab_of(const glm::dvec3& rgb) {
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    const double x = f((0.4124 * rgb.x + 0.3576 * rgb.y + 0.1805 * rgb.z) / 0.9505),
                 y = f(0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z),
                 z = f((0.0193 * rgb.x + 0.1192 * rgb.y + 0.9505 * rgb.z) / 1.0890);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// Over the pixels, or squares of them, where anything is drawn.
struct SeenDifference {
    double mean = 0.0, largest = 0.0;
    double noticeable_share = 0.0;  ///< of those, differences above the just noticeable one
    size_t pixels = 0;
};

/// @param a, b  of equal size
/// @param is_counted  [pixels]
inline SeenDifference lab_difference(const LightImage& a, const LightImage& b,
                                     const std::vector<bool>& is_counted) {
    SeenDifference out;
    for (size_t i = 0; i < a.light.size(); ++i) {
        if (!is_counted[i]) continue;
        const double apart = glm::distance(lab_of(a.light[i]), lab_of(b.light[i]));
        out.mean += apart;
        out.largest = std::max(out.largest, apart);
        out.noticeable_share += apart > kJustNoticeable ? 1.0 : 0.0;
        ++out.pixels;
    }
    out.mean /= double(std::max<size_t>(out.pixels, 1));
    out.noticeable_share /= double(std::max<size_t>(out.pixels, 1));
    return out;
}

/// @param a, b  of equal size, `factor` times as large as they are seen, divisible by it
/// @param is_counted  [pixels as seen]
inline SeenDifference seen_difference(const render::ColourImage& a, const render::ColourImage& b, int factor,
                                      const std::vector<bool>& is_counted) {
    return lab_difference(blurred(averaged(a, factor)), blurred(averaged(b, factor)), is_counted);
}

/// The same of the mean light of squares, those of which at least half the pixels count.
/// @param side_px  of a square, in pixels as seen; what is left at the right and the lower edge does not count
inline SeenDifference square_difference(const render::ColourImage& a, const render::ColourImage& b,
                                        int factor, int side_px, const std::vector<bool>& is_counted) {
    const LightImage mean_a = averaged(a, factor * side_px), mean_b = averaged(b, factor * side_px);
    const int width = a.width / factor;
    std::vector<bool> counts;
    for (int y = 0; y < mean_a.height; ++y) {
        for (int x = 0; x < mean_a.width; ++x) {
            int inside = 0;
            for (int i = 0; i < side_px * side_px; ++i)
                inside += is_counted[static_cast<size_t>((y * side_px + i / side_px) * width + x * side_px +
                                                         i % side_px)];
            counts.push_back(2 * inside >= side_px * side_px);
        }
    }
    return lab_difference(mean_a, mean_b, counts);
}

}  // namespace sim_test
