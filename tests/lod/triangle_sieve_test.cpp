// What the sieve leaves out against a depth buffer in double precision, pixel by pixel.
#include "lod/triangle_sieve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <vector>

#include "lod/base/rng.h"
#include "tests/lod/eye_views.h"

namespace {

using lod_test::view_of;
using Corners = std::array<glm::dvec3, 3>;  ///< eye frame, metres

/// Many small ones over one another, some long and thin, some that reach behind the eye or far out of the picture.
std::vector<Corners> random_triangles(lod::Rng& rng, size_t count) {
    std::vector<Corners> out;
    for (size_t i = 0; i < count; ++i) {
        const double depth_m = rng.between(5.0, 60.0), size_m = depth_m * rng.between(0.005, 0.2);
        const glm::dvec3 middle(rng.between(-1.0, 1.0) * depth_m, rng.between(-0.7, 0.7) * depth_m, -depth_m);
        const double stretch = rng.below(8) == 0 ? 6.0 : 1.0;
        Corners corners;
        for (glm::dvec3& corner : corners) {
            const glm::dvec3 off(rng.between(-stretch, stretch), rng.between(-1.0, 1.0),
                                 rng.between(-1.0, 1.0));
            corner = middle + size_m * off;
        }
        if (rng.below(200) == 0) corners[0].z = 3.0;
        out.push_back(corners);
    }
    return out;
}

double least_depth_m(const Corners& corners) {
    return -std::max({corners[0].z, corners[1].z, corners[2].z});
}

/// Depth at which the ray of a pixel meets a triangle, by solving for the weights of its corners in space; infinite when it
/// does not.
double hit_depth_m(const Corners& t, const glm::dvec2& slope) {
    const glm::dvec3 ray(slope, -1.0);
    const double whole = glm::dot(t[0], glm::cross(t[1], t[2]));
    const glm::dvec3 weight(glm::dot(ray, glm::cross(t[1], t[2])), glm::dot(ray, glm::cross(t[2], t[0])),
                            glm::dot(ray, glm::cross(t[0], t[1])));
    const double sum = weight.x + weight.y + weight.z;
    if (sum == 0.0) return std::numeric_limits<double>::infinity();
    const double depth_m = whole / sum;
    const bool is_in = std::min({weight.x / sum, weight.y / sum, weight.z / sum}) >= 0.0;
    return is_in && depth_m > 0.0 ? depth_m : std::numeric_limits<double>::infinity();
}

/// Whether some pixel shows each: a depth buffer. What reaches through the near plane is left out.
std::vector<bool> show(const lod::View& view, const std::vector<Corners>& triangles) {
    constexpr size_t kNothing = SIZE_MAX;
    const lod::ViewMetric metric = lod::metric_of(view);
    const glm::ivec2 size(view.width_px, view.height_px);
    const glm::dvec2 middle = 0.5 * glm::dvec2(size);
    std::vector<double> depth_m(size_t(size.x * size.y), std::numeric_limits<double>::infinity());
    std::vector<size_t> nearest(depth_m.size(), kNothing);
    for (size_t i = 0; i < triangles.size(); ++i) {
        if (least_depth_m(triangles[i]) <= view.near_m) continue;
        glm::dvec2 low(1e30), high(-1e30);
        for (const glm::dvec3& corner : triangles[i]) {
            const glm::dvec2 at = middle + glm::dvec2(corner) * (metric.lambda_px / -corner.z);
            low = glm::min(low, at), high = glm::max(high, at);
        }
        const glm::ivec2 first(glm::clamp(low, glm::dvec2(0.0), glm::dvec2(size))),
            last(glm::clamp(high, glm::dvec2(-1.0), glm::dvec2(size) - 1.0));
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                const glm::dvec2 slope = (glm::dvec2(x, y) + 0.5 - middle) / metric.lambda_px;
                const double here_m = hit_depth_m(triangles[i], slope);
                const auto pixel = static_cast<size_t>(y * size.x + x);
                if (here_m < depth_m[pixel]) depth_m[pixel] = here_m, nearest[pixel] = i;
            }
        }
    }
    std::vector<bool> shows(triangles.size());
    for (const size_t i : nearest) {
        if (i != kNothing) shows[i] = true;
    }
    return shows;
}

/// Sifts triangles, each a piece of its own from near to far, in so many strips of the picture. @returns whether each was
/// kept
std::vector<bool> sift(const lod::View& view, const std::vector<Corners>& triangles, int strips) {
    const lod::Instance instance =
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kObjects);
    std::vector<uint8_t> shows(triangles.size());
    for (int strip = 0; strip < strips; ++strip) {
        lod::Columns own;
        if (strip > 0) own.left_px = float(view.width_px * strip) / float(strips);
        if (strip + 1 < strips) own.right_px = float(view.width_px * (strip + 1)) / float(strips);
        lod::TriangleSieve sieve;
        sieve.begin(view, own);
        for (size_t i = 0; i < triangles.size(); ++i) {
            std::array<lod::Vertex, 5> vertices{};  // a range of them is used
            for (size_t k = 0; k < 3; ++k) {
                const glm::dvec3 world =
                    view.eye_world + glm::transpose(view.eye_from_world) * triangles[i][k];
                vertices[k + 1] = lod::make_vertex(world, {0.0f, 0.0f, 1.0f}, {}, lod::Material::kPaint);
            }
            const uint8_t before = shows[i];
            sieve.sift(vertices, std::array<uint32_t, 3>{3, 1, 2}, instance, std::span(shows).subspan(i, 1));
            EXPECT_TRUE(before == 0 || shows[i] == before) << "judged twice";
        }
    }
    return {shows.begin(), shows.end()};
}

TEST(TriangleSieve, KeepsWhatAnyPixelShowsAndLittleElse) {
    lod::Rng rng(17);
    size_t all = 0, showing = 0, kept = 0;
    for (int round = 0; round < 12; ++round) {
        lod::View view = view_of(150 + 10 * (round % 7), 100 + 3 * (round % 5));
        view = lod::look_at(glm::dvec3(1e5, -2e5, 300.0), glm::dvec3(1e5 + 40.0, -2e5 + 10.0 * round, 290.0),
                            {0.0, 0.0, 1.0}, view);
        std::vector<Corners> triangles = random_triangles(rng, 3000);
        std::sort(triangles.begin(), triangles.end(),
                  [](const Corners& a, const Corners& b) { return least_depth_m(a) < least_depth_m(b); });
        const std::vector<bool> is_kept = sift(view, triangles, 1 + round % 3);
        const std::vector<bool> shows = show(view, triangles);
        for (size_t i = 0; i < triangles.size(); ++i)
            ASSERT_TRUE(is_kept[i] || !shows[i]) << "round " << round << ", triangle " << i;
        for (size_t i = 0; i < triangles.size(); ++i) {
            if (least_depth_m(triangles[i]) <= view.near_m) {
                EXPECT_TRUE(is_kept[i]) << "reaches through the near plane";
                continue;
            }
            ++all;
            showing += shows[i];
            kept += is_kept[i];
        }
    }
    std::printf("%zu triangles, %zu show, %zu kept\n", all, showing, kept);
    EXPECT_LT(kept, 2 * all / 3);
    EXPECT_LT(2 * kept, 5 * showing);
}

}  // namespace
