#include "data/ecef_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace data {

namespace {

constexpr int kNodes = 4;  // per axis
constexpr int kMaxShift = 8;
constexpr int kTrialsPerAxis = 4;
constexpr int64_t kMaxSingleSamples = 1 << 20;
constexpr double kAimedError_m = 1e-4;
constexpr std::array<double, 2> kProvedHeights_m = {-500.0, 9000.0};

// T_i(u) T_j(v) for i + j <= 3, low degrees first: the first six are those of degree <= 2.
struct Term {
    int i, j;
};
constexpr std::array<Term, 10> kTerms = {
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};

// Where the fit is compared with the truth: corners, and the middle.
constexpr std::array<glm::dvec2, 5> kProbes = {{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}, {0, 0}}};

std::array<double, 10> terms_at(double u, double v) {
    const double u2 = 2.0 * u * u - 1.0, v2 = 2.0 * v * v - 1.0;
    return {1.0, u, v, u2, u * v, v2, (2.0 * u2 - 1.0) * u, u2 * v, u * v2, (2.0 * v2 - 1.0) * v};
}

double node(int k) {
    return std::cos((2 * k + 1) * std::numbers::pi / (2 * kNodes));
}

// Discrete orthogonality of the Chebyshev polynomials over their nodes.
double node_weight(const Term& term) {
    return (term.i == 0 ? 1.0 : 2.0) * (term.j == 0 ? 1.0 : 2.0) / (kNodes * kNodes);
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

glm::ivec2 EcefPatches::block_origin(int block_col, int block_row) const {
    return glm::min(glm::ivec2(block_col, block_row) << shift_, last_origin_);
}

bool EcefPatches::fit_block(glm::ivec2 block, const ExactGround& exact, Patch& out) {
    constexpr size_t kFitted = kNodes * kNodes;
    std::array<glm::dvec2, kFitted + kProbes.size()> uv;
    for (int k = 0; k < kNodes; ++k) {
        for (int l = 0; l < kNodes; ++l)
            uv[static_cast<size_t>(k * kNodes + l)] = {node(k), node(l)};
    }
    std::copy(kProbes.begin(), kProbes.end(), uv.begin() + kFitted);

    const glm::dvec2 centre = glm::dvec2(block_origin(block.x, block.y)) + centre_cells_;
    std::array<glm::dvec2, uv.size()> grid;
    for (size_t p = 0; p < uv.size(); ++p)
        grid[p] = centre + uv[p] * half_cells_;
    std::array<GroundPoint, uv.size()> truth;
    exact(grid, truth);
    for (const GroundPoint& point : truth) {
        if (!is_finite(point.base)) return false;
    }

    out = {};
    for (size_t p = 0; p < kFitted; ++p) {
        const std::array<double, 10> t = terms_at(uv[p].x, uv[p].y);
        for (size_t k = 0; k < 10; ++k)
            out.base[k] += truth[p].base * (t[k] * node_weight(kTerms[k]));
        for (size_t k = 0; k < 6; ++k)
            out.up[k] += truth[p].up * (t[k] * node_weight(kTerms[k]));
    }
    for (size_t p = kFitted; p < uv.size(); ++p) {
        const std::array<double, 10> t = terms_at(uv[p].x, uv[p].y);
        GroundPoint off = {-truth[p].base, -truth[p].up};
        for (size_t k = 0; k < 10; ++k)
            off.base += out.base[k] * t[k];
        for (size_t k = 0; k < 6; ++k)
            off.up += out.up[k] * t[k];
        for (double h : kProvedHeights_m)
            error_m_ = std::max(error_m_, glm::length(off.base + off.up * h));
    }
    return true;
}

void EcefPatches::cut_into_blocks(int shift) {
    const glm::ivec2 size(width_, height_);
    const glm::ivec2 extent = glm::min(size, glm::ivec2(1 << shift));
    shift_ = shift;
    blocks_ = (size + extent - 1) / extent;
    last_origin_ = size - extent;
    centre_cells_ = glm::dvec2(extent - 1) * 0.5;
    half_cells_ = glm::max(centre_cells_, glm::dvec2(0.5));
    per_half_cell_ = 1.0 / half_cells_;
}

// Fits every stride-th block each way; keeps the patches when that is all of them.
lod::Result<lod::Ok> EcefPatches::fit_every(int stride, const ExactGround& exact) {
    error_m_ = 0.0;
    if (stride == 1) patches_.resize(static_cast<size_t>(blocks_.x) * static_cast<size_t>(blocks_.y));
    Patch trial;
    for (int row = 0; row < blocks_.y; row += stride) {
        for (int col = 0; col < blocks_.x; col += stride) {
            if (!fit_block({col, row}, exact, stride == 1 ? patches_[index_of(col, row)] : trial)) {
                const glm::ivec2 at = block_origin(col, row);
                return lod::Error{"samples near column " + std::to_string(at.x) + ", row " +
                                  std::to_string(at.y) + " have no place on the Earth in this CRS"};
            }
        }
    }
    return lod::Ok{};
}

lod::Result<EcefPatches> EcefPatches::fit(int width, int height, const ExactGround& exact) {
    CHECK(width >= 1 && height >= 1);
    EcefPatches patches;
    patches.width_ = width;
    patches.height_ = height;
    const int min_shift = int64_t{width} * height > kMaxSingleSamples ? 2 : 0;
    for (int shift = kMaxShift; shift >= min_shift; --shift) {
        patches.cut_into_blocks(shift);
        const int blocks = std::max(patches.blocks_.x, patches.blocks_.y);
        for (int stride : {std::max(1, blocks / kTrialsPerAxis), 1}) {  // a few blocks rule most sizes out
            if (const auto done = patches.fit_every(stride, exact); !done) return done.error();
            if (patches.error_m_ > kAimedError_m && shift > min_shift) break;
            if (stride == 1) return patches;
        }
    }
    return patches;
}

// The sums are written as trees: a running sum would wait for itself sixteen times.
glm::dvec3 EcefPatches::at(int col, int row, double height_m) const {
    const int block_col = col >> shift_, block_row = row >> shift_;
    const int from_col = col - std::min(block_col << shift_, last_origin_.x);
    const int from_row = row - std::min(block_row << shift_, last_origin_.y);
    const auto& [b, w] = patches_[index_of(block_col, block_row)];
    const std::array<double, 10> t = terms_at((from_col - centre_cells_.x) * per_half_cell_.x,
                                              (from_row - centre_cells_.y) * per_half_cell_.y);
    const glm::dvec3 up = (w[0] + w[1] * t[1]) + ((w[2] * t[2] + w[3] * t[3]) + (w[4] * t[4] + w[5] * t[5]));
    const glm::dvec3 low = (b[0] + b[1] * t[1]) + ((b[2] * t[2] + b[3] * t[3]) + (b[4] * t[4] + b[5] * t[5]));
    const glm::dvec3 high = (b[6] * t[6] + b[7] * t[7]) + (b[8] * t[8] + b[9] * t[9]);
    return (low + high) + up * height_m;
}

}  // namespace data
