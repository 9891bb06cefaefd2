#include "data/chord_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace data {

namespace {

constexpr int kNodes = 33;  // per axis
constexpr double kStepsPerExtent = 64.0;
constexpr double kSafety = 1.25;
constexpr double kRounding_m = 1e-8;  // of a second difference of ECEF coordinates
constexpr std::array<double, 2> kHeights_m = {-500.0, 12000.0};

// The symmetric 2x2 matrix of one component's second derivatives.
struct Hessian {
    double cc = 0.0, cr = 0.0, rr = 0.0;

    // The largest |second derivative| along a unit direction: the larger eigenvalue.
    double norm() const {
        const double mean = 0.5 * (cc + rr), half = 0.5 * (cc - rr);
        return std::abs(mean) + std::hypot(half, cr);
    }
};

// Nine ground points around a node, [row offset + 1][column offset + 1].
using Stencil = std::array<GroundPoint, 9>;

struct Bend {
    double up_m = 0.0, side_m = 0.0;  // per cell^2
};

Bend bend_at(const Stencil& s, const glm::dvec2& step, double height_m) {
    std::array<glm::dvec3, 9> f;
    for (size_t k = 0; k < 9; ++k)
        f[k] = s[k].base + s[k].up * height_m;
    const glm::dvec3 cc = (f[3] - 2.0 * f[4] + f[5]) / (step.x * step.x);
    const glm::dvec3 rr = (f[1] - 2.0 * f[4] + f[7]) / (step.y * step.y);
    const glm::dvec3 cr = (f[0] - f[2] - f[6] + f[8]) / (4.0 * step.x * step.y);

    const glm::dvec3 up = s[4].up;
    const glm::dvec3 any = std::abs(up.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 east = glm::normalize(glm::cross(any, up)), north = glm::cross(up, east);
    const auto along = [&](const glm::dvec3& axis) {
        return Hessian{glm::dot(cc, axis), glm::dot(cr, axis), glm::dot(rr, axis)}.norm();
    };
    const double rounding = kRounding_m / std::min({step.x * step.x, step.y * step.y, step.x * step.y});
    return {along(up) + rounding, std::hypot(along(east), along(north)) + rounding};
}

// The sine of the largest angle between two verticals; 1 from a right angle on.
double largest_turn(const std::vector<glm::dvec3>& ups) {
    double min_cos = 1.0;
    for (const glm::dvec3& a : ups) {
        for (const glm::dvec3& b : ups)
            min_cos = std::min(min_cos, glm::dot(a, b));
    }
    return min_cos <= 0.0 ? 1.0 : std::sqrt(std::max(0.0, 1.0 - min_cos * min_cos));
}

}  // namespace

GroundFrame::ChordError chord_error_of(int width, int height, const ExactGround& exact) {
    const glm::dvec2 extent(width - 1, height - 1);
    const glm::dvec2 step = glm::max(extent / kStepsPerExtent, glm::dvec2(0.5));
    const glm::dvec2 first = glm::min(step, extent * 0.5), last = extent - first;
    Bend worst;
    std::vector<glm::dvec3> ups;
    for (int j = 0; j < kNodes; ++j) {
        for (int i = 0; i < kNodes; ++i) {
            const glm::dvec2 node = first + (last - first) * (glm::dvec2(i, j) / double(kNodes - 1));
            std::array<glm::dvec2, 9> grid;
            for (int k = 0; k < 9; ++k)
                grid[static_cast<size_t>(k)] = node + step * glm::dvec2(k % 3 - 1, k / 3 - 1);
            Stencil stencil;
            exact(grid, stencil);
            if (i % 8 == 0 && j % 8 == 0) ups.push_back(stencil[4].up);
            for (double h : kHeights_m) {
                const Bend bend = bend_at(stencil, step, h);
                worst.up_m = std::max(worst.up_m, bend.up_m);
                worst.side_m = std::max(worst.side_m, bend.side_m);
            }
        }
    }
    const double turn = largest_turn(ups);
    return {(worst.up_m + turn * worst.side_m) * kSafety / 8.0,
            (worst.side_m + turn * worst.up_m) * kSafety / 8.0};
}

}  // namespace data
