#include "sim/street_cover.h"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

/// One straight piece, in texels.
struct Piece {
    glm::dvec2 from{0.0}, to{0.0};
    double half_width_m = 0.0;
};

/// The texels whose middle may lie within reach of a piece, inside the texture.
struct Reach {
    glm::ivec2 low{0}, high{-1};  ///< inclusive; high < low: none
};

Reach reach_of(const Piece& piece, const glm::dvec2& texel_m, const glm::ivec2& texture_px) {
    const glm::dvec2 margin = piece.half_width_m / texel_m + 1.0;
    const glm::dvec2 low = glm::floor(glm::min(piece.from, piece.to) - margin);
    const glm::dvec2 high = glm::ceil(glm::max(piece.from, piece.to) + margin);
    const glm::dvec2 last(texture_px - 1);
    if (high.x < 0.0 || high.y < 0.0 || low.x > last.x || low.y > last.y) return {};
    return {glm::ivec2(glm::max(low, 0.0)), glm::ivec2(glm::min(high, last))};
}

double distance_m(const Piece& piece, const glm::dvec2& texel, const glm::dvec2& texel_m) {
    const glm::dvec2 way = (piece.to - piece.from) * texel_m, out = (texel - piece.from) * texel_m;
    const double length_2 = glm::dot(way, way);
    const double part = length_2 > 0.0 ? std::clamp(glm::dot(out, way) / length_2, 0.0, 1.0) : 0.0;
    return glm::length(out - part * way);
}

/// Share of a texel that a strip covers whose middle line passes at a distance, both seen along the strip.
double strip_share(double distance, double half_width, double texel) {
    const double low = std::max(distance - half_width, -texel / 2.0);
    const double high = std::min(distance + half_width, texel / 2.0);
    return std::max(high - low, 0.0) / texel;
}

std::vector<Piece> pieces_of(std::span<const data::Street> streets, const data::HeightGrid& grid,
                             const glm::ivec2& texture_px) {
    const glm::dvec2 texels_per_sample = glm::dvec2(texture_px) / glm::dvec2(grid.width, grid.height);
    std::vector<Piece> pieces;
    for (const data::Street& street : streets) {
        for (size_t i = 0; i + 1 < street.line.size(); ++i) {
            const auto texel = [&](const glm::dvec2& site) {
                return (grid.frame.grid_from_site({site.x, site.y, 0.0}) + 0.5) * texels_per_sample - 0.5;
            };
            pieces.push_back({texel(street.line[i]), texel(street.line[i + 1]), street.width_m / 2.0});
        }
    }
    return pieces;
}

}  // namespace

StreetCover cover_streets(std::span<const data::Street> streets, const data::HeightGrid& grid,
                          const glm::ivec2& texture_px) {
    const std::vector<Piece> pieces = pieces_of(streets, grid, texture_px);
    const glm::dvec2 texel_m =
        grid.frame.cell_m() * glm::dvec2(grid.width, grid.height) / glm::dvec2(texture_px);
    glm::ivec2 low = texture_px, high(-1);
    for (const Piece& piece : pieces) {
        const Reach reach = reach_of(piece, texel_m, texture_px);
        if (reach.high.x < reach.low.x) continue;
        low = glm::min(low, reach.low);
        high = glm::max(high, reach.high);
    }
    StreetCover cover;
    if (high.x < low.x) return cover;
    cover.first = low;
    cover.size = high - low + 1;
    cover.share.resize(static_cast<size_t>(cover.size.x) * static_cast<size_t>(cover.size.y));
    const double texel = std::sqrt(texel_m.x * texel_m.y);
    for (const Piece& piece : pieces) {
        const Reach reach = reach_of(piece, texel_m, texture_px);
        for (int y = reach.low.y; y <= reach.high.y; ++y) {
            for (int x = reach.low.x; x <= reach.high.x; ++x) {
                const double share =
                    strip_share(distance_m(piece, glm::dvec2(x, y), texel_m), piece.half_width_m, texel);
                const glm::ivec2 at = glm::ivec2(x, y) - cover.first;
                uint8_t& covered = cover.share[static_cast<size_t>(at.y) * static_cast<size_t>(cover.size.x) +
                                               static_cast<size_t>(at.x)];
                covered = std::max(covered, static_cast<uint8_t>(share * 255.0 + 0.5));
            }
        }
    }
    return cover;
}

}  // namespace sim
