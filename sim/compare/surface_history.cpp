#include "sim/compare/surface_history.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/base/hash.h"
#include "sim/compare/surface.h"

namespace sim {
namespace {

using terrain::DrawnTriangle;
using Keys = std::vector<std::pair<uint64_t, uint32_t>>;

uint64_t hash_of(const terrain::GridPoint& p) {
    return lod::mix64(static_cast<uint64_t>(p.y) << 16 | static_cast<uint64_t>(p.x));
}

uint64_t hash_of(const glm::dvec3& p) {
    uint64_t hash = 0;
    for (const double part : {p.x, p.y, p.z})
        hash = lod::hash_combine(hash, std::bit_cast<uint64_t>(part));
    return hash;
}

/// The same whichever corner comes first.
uint64_t hash_of(const std::array<uint64_t, 3>& corners) {
    return lod::mix64(corners[0] + corners[1] + corners[2]) ^ (corners[0] ^ corners[1] ^ corners[2]);
}

template <typename Corners>
Keys keys_of(const std::vector<DrawnTriangle>& triangles, const Corners& corners) {
    Keys keys(triangles.size());
    for (uint32_t i = 0; i < keys.size(); ++i) {
        const auto& c = corners(triangles[i]);
        keys[i] = {hash_of(std::array{hash_of(c[0]), hash_of(c[1]), hash_of(c[2])}), i};
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

/// Those of `keys` that are not among `others`, as triangles.
std::vector<uint32_t> missing(const Keys& keys, const Keys& others) {
    std::vector<uint32_t> out;
    auto other = others.begin();
    for (const auto& [hash, triangle] : keys) {
        while (other != others.end() && other->first < hash)
            ++other;
        if (other == others.end() || other->first != hash) out.push_back(triangle);
    }
    return out;
}

}  // namespace

SurfaceHistory::SurfaceHistory(const data::HeightGrid& grid)
    : grid_(grid), above_m_(grid.height_m.size(), std::nanf("")) {}

SurfaceChange SurfaceHistory::add(const lod::View& view, std::vector<DrawnTriangle> triangles) {
    const Keys corners = keys_of(
        triangles, [](const DrawnTriangle& t) -> auto& { return t.samples; });
    const Keys places = keys_of(
        triangles, [](const DrawnTriangle& t) -> auto& { return t.world; });
    SurfaceChange change;
    const double jump_px = move(view, triangles, places);
    if (!is_first_ && !triangles.empty()) {
        change.changed_share =
            static_cast<double>(missing(corners, corners_).size()) / static_cast<double>(triangles.size());
        change.popping_px = jump_px;
    }
    view_ = view;
    triangles_ = std::move(triangles);
    corners_ = corners;
    places_ = places;
    is_first_ = false;
    return change;
}

/// Compares what is new with what was there, then forgets what is gone and keeps what is new.
double SurfaceHistory::move(const lod::View& view, const std::vector<DrawnTriangle>& triangles,
                            const Keys& places) {
    const std::vector<uint32_t> added = missing(places, places_), gone = missing(places_, places);
    double worst_px = 0.0;
    for (const uint32_t i : added) {
        for_samples_under(triangles[i], EdgeRule::kOne, [&](int col, int row) {
            const float before_m = above_m_[grid_.index(col, row)];
            if (std::isnan(before_m)) return;
            const SamplePlace place = place_of(grid_, col, row);
            // What nobody saw cannot be seen to jump.
            if (apart_px(view_, place, static_cast<double>(before_m), 0.0) < 0.0) return;
            const double now_m = above_m(triangles[i], place);
            worst_px = std::max(worst_px, apart_px(view, place, now_m, static_cast<double>(before_m)));
        });
    }
    for (const uint32_t i : gone) {
        for_samples_under(triangles_[i], EdgeRule::kOne,
                          [&](int col, int row) { above_m_[grid_.index(col, row)] = std::nanf(""); });
    }
    for (const uint32_t i : added) {
        for_samples_under(triangles[i], EdgeRule::kOne, [&](int col, int row) {
            above_m_[grid_.index(col, row)] =
                static_cast<float>(above_m(triangles[i], place_of(grid_, col, row)));
        });
    }
    return worst_px;
}

}  // namespace sim
