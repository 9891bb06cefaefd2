// The bound of gliding triangles beside every sample of a small rough relief, in metres instead of pixels.
#include "terrain/gliding_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lod/base/rng.h"
#include "terrain/vertex_star.h"

namespace {

using terrain::BintreeTriangle;
using terrain::DiamondIndex;
using terrain::GridPoint;

constexpr int kSide = 16;

/// A mesh over random heights, some of whose vertices are anywhere on their way.
struct GlidingRelief {
    explicit GlidingRelief(uint64_t seed) : rng(seed), mesh(terrain::make_domain(kSide + 1, kSide + 1)) {
        for (double& height : heights)
            height = rng.between(-1.0, 1.0);
        split_some(1 + rng.below(120));
        glide_some(rng.unit());
    }

    double height(GridPoint p) const { return heights[static_cast<size_t>(p.y * (kSide + 1) + p.x)]; }
    glm::vec3 place(DiamondIndex vertex) const {
        const GridPoint p = mesh[vertex].centre();
        return {float(p.x), float(p.y), float(height(p))};
    }

    void split_some(uint64_t count) {
        for (uint64_t i = 0; i < 8 * count; ++i) {
            const auto index = static_cast<DiamondIndex>(
                terrain::kRoot + rng.below(mesh.record_count() - terrain::kCornerCount));
            if (!mesh[index].is_split && mesh.missing_parent(index) == terrain::kOutside) mesh.split(index);
        }
    }

    /// Each sets out at a moment of its own, so weights fall into any order.
    void glide_some(double share) {
        for (DiamondIndex index = terrain::kRoot; index < mesh.record_count(); ++index) {
            if (!mesh[index].is_split || rng.unit() > share) continue;
            terrain::VertexGlide glide;
            glide.index = index;
            const auto [from, to] = mesh.edge_ends(index);
            glide.base.ends = {from, to, from};
            glide.base.shares = {0.5f, 0.5f, 0.0f};
            for (size_t end = 0; end < 3; ++end)
                glide.base.levels[end] = static_cast<uint8_t>(mesh[glide.base.ends[end]].level);
            glide.base_from_place_m = 0.5f * (place(from) + place(to)) - place(index);
            glides.start(glide, static_cast<int>(mesh[index].level), rng.unit() < 0.3, rng.between(0.0, 1.0));
        }
        std::vector<DiamondIndex> back;
        glides.advance(1.0, back);
        for (int level = 0; level <= mesh.domain().finest_level(); ++level) {
            for (terrain::VertexGlide& glide : glides.at_level(level))
                glide.error_px = static_cast<float>(split_error(glide.index)) * (1.0f + 0x1p-20f);
        }
    }

    /// Of the two triangles that a diamond was.
    double split_error(DiamondIndex index) const {
        const auto [from, to] = mesh.edge_ends(index);
        double worst = 0.0;
        for (uint32_t which = 0; which < 2; ++which) {
            const DiamondIndex apex = mesh[index].parent(which);
            if (terrain::is_record(apex)) worst = std::max(worst, error({index, 0, apex, from, to}, false));
        }
        return worst;
    }

    /// The farthest any sample is from a triangle, vertically; vertices where they are shown, or at their places.
    double error(const BintreeTriangle& t, bool is_shown) const {
        std::array<glm::dvec3, 3> corner;
        for (size_t i = 0; i < 3; ++i) {
            const DiamondIndex vertex = i == 0 ? t.apex : i == 1 ? t.left : t.right;
            corner[i] = glm::dvec3(place(vertex));
            if (is_shown)
                corner[i] += glm::dvec3(glides.displacement_m(vertex, static_cast<int>(mesh[vertex].level)));
        }
        const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        };
        const double whole = area(corner[0], corner[1], corner[2]);
        double worst = 0.0;
        for (int y = 0; y <= kSide; ++y) {
            for (int x = 0; x <= kSide; ++x) {
                const glm::dvec3 p(x, y, 0.0);
                const double a = area(p, corner[1], corner[2]) / whole,
                             b = area(p, corner[2], corner[0]) / whole;
                const double c = 1.0 - a - b;
                if (std::min({a, b, c}) < -1e-9) continue;
                const double drawn = a * corner[0].z + b * corner[1].z + c * corner[2].z;
                worst = std::max(worst, std::abs(drawn - height({x, y})));
            }
        }
        return worst;
    }

    template <typename Visit>
    void visit_leaves(const Visit& visit) const {
        std::vector<BintreeTriangle> waiting{root_triangle(mesh, 0), root_triangle(mesh, 1)};
        while (!waiting.empty()) {
            const BintreeTriangle t = waiting.back();
            waiting.pop_back();
            if (is_leaf(mesh, t)) {
                visit(t);
                continue;
            }
            for (const BintreeTriangle& child : children_of(mesh, t))
                waiting.push_back(child);
        }
    }

    lod::Rng rng;
    std::array<double, (kSide + 1) * (kSide + 1)> heights{};
    terrain::DiamondMesh mesh;
    terrain::VertexGlides glides{1.0};
};

TEST(GlidingTriangle, IsNoFartherOffThanTold) {
    int gliding = 0, better = 0, tight = 0;
    for (uint64_t seed = 1; seed <= 300; ++seed) {
        const GlidingRelief relief(seed);
        const auto way = [](const terrain::VertexGlide& glide, const BintreeTriangle&) {
            return double(glm::length(glide.shown_m));
        };
        relief.visit_leaves([&](const BintreeTriangle& t) {
            const double still = relief.error(t, false), off = relief.error(t, true);
            double ways = 0.0;
            for (const DiamondIndex corner : {t.apex, t.left, t.right})
                ways += double(glm::length(
                    relief.glides.displacement_m(corner, static_cast<int>(relief.mesh[corner].level))));
            const double told = terrain::gliding_error_px(relief.mesh, relief.glides, t, still, way);
            EXPECT_LE(off, told + 1e-5) << "seed " << seed;
            EXPECT_LE(told, still + ways + 1e-5);
            if (ways == 0.0) return;
            ++gliding;
            better += told < still + 0.9 * ways;
            tight += off > 0.9 * told;
        });
    }
    EXPECT_GT(gliding, 5000);
    EXPECT_GT(better, gliding / 8);
    EXPECT_GT(tight, gliding / 10);
}

TEST(GlidingTriangle, ParentIsWhatWasSplit) {
    const GlidingRelief relief(5);
    int checked = 0;
    std::vector<BintreeTriangle> waiting{root_triangle(relief.mesh, 0), root_triangle(relief.mesh, 1)};
    while (!waiting.empty()) {
        const BintreeTriangle t = waiting.back();
        waiting.pop_back();
        if (is_leaf(relief.mesh, t)) continue;
        for (const BintreeTriangle& child : children_of(relief.mesh, t)) {
            const BintreeTriangle parent = parent_of(relief.mesh, child);
            EXPECT_EQ(parent.diamond, t.diamond);
            EXPECT_EQ(parent.half, t.half);
            EXPECT_EQ(parent.apex, t.apex);
            EXPECT_EQ(parent.left, t.left);
            EXPECT_EQ(parent.right, t.right);
            waiting.push_back(child);
            ++checked;
        }
    }
    EXPECT_GT(checked, 50);
}

}  // namespace
