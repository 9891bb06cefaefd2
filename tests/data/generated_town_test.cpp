#include "data/generated_town.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/geos_border.h"

namespace data {
namespace {

TEST(GeneratedTown, HasStreetsOfHousesCourtyardsAndAChurch) {
    const std::vector<TownBuilding> town = generate_town({});
    EXPECT_GT(town.size(), 600u);
    EXPECT_LT(town.size(), 900u);
    size_t courtyards = 0;
    double highest = 0.0;
    for (const TownBuilding& building : town) {
        ASSERT_GT(building.height_m, 3.0);
        highest = std::max(highest, building.height_m);
        courtyards += building.rings.size() - 1;
        for (size_t ring = 0; ring < building.rings.size(); ++ring) {
            const double area = twice_signed_area(building.rings[ring]) / 2.0;
            EXPECT_EQ(area > 0.0, ring == 0);
            EXPECT_GT(std::abs(area), 20.0);
        }
    }
    EXPECT_GT(courtyards, 5u);
    EXPECT_EQ(highest, 41.0);
}

TEST(GeneratedTown, IsTallestInTheMiddle) {
    double inner = 0.0, outer = 0.0;
    int inner_count = 0, outer_count = 0;
    for (const TownBuilding& building : generate_town({})) {
        const double distance = glm::length(building.rings[0][0]);
        if (distance < 180.0) {
            inner += building.height_m;
            ++inner_count;
        } else if (distance > 400.0) {
            outer += building.height_m;
            ++outer_count;
        }
    }
    EXPECT_GT(inner / inner_count, 1.6 * outer / outer_count);
}

TEST(GeneratedTown, NoBuildingStandsInAnother) {
    for (const uint64_t seed : {1u, 2u, 3u}) {
        const std::vector<TownBuilding> town = generate_town({.seed = seed});
        const GeosContextPtr context = make_geos_context();
        std::vector<GeosGeometryPtr> areas;
        for (const TownBuilding& building : town) {
            areas.push_back(geos_from_polygon(context.get(), {building.rings}));
            ASSERT_NE(areas.back(), nullptr);
            EXPECT_EQ(GEOSisValid_r(context.get(), areas.back().get()), 1);
        }
        for (size_t i = 0; i < town.size(); ++i) {
            for (size_t k = i + 1; k < town.size(); ++k) {
                if (glm::distance(town[i].rings[0][0], town[k].rings[0][0]) > 200.0) continue;
                const GeosGeometryPtr shared(
                    GEOSIntersection_r(context.get(), areas[i].get(), areas[k].get()),
                    GeosGeometryCloser{context.get()});
                double area = 0.0;
                GEOSArea_r(context.get(), shared.get(), &area);
                ASSERT_LT(area, 1e-6) << "seed " << seed << ": " << i << " and " << k;
            }
        }
    }
}

TEST(GeneratedTown, StreetsPassBetweenTheHouses) {
    const std::vector<TownStreet> streets = generate_streets({});
    const std::vector<TownBuilding> town = generate_town({});
    EXPECT_GT(streets.size(), 200u);
    const double half_width_m = TownOptions{}.street_width_m / 2.0;
    double closest_m = 1e9;
    for (const TownStreet& street : streets) {
        const glm::dvec2 way = street.to - street.from;
        EXPECT_NEAR(glm::length(way), 87.0, 25.0);
        for (const TownBuilding& building : town) {
            for (const glm::dvec2& corner : building.rings[0]) {
                const glm::dvec2 out = corner - street.from;
                const double part = std::clamp(glm::dot(out, way) / glm::dot(way, way), 0.0, 1.0);
                closest_m = std::min(closest_m, glm::length(out - part * way));
            }
        }
    }
    EXPECT_GT(closest_m, 0.85 * half_width_m);  // blocks are not quite rectangles
    EXPECT_LT(closest_m, 1.1 * half_width_m);
}

TEST(GeneratedTown, FollowsItsSeed) {
    const auto corner = [](uint64_t seed) { return generate_town({.seed = seed})[40].rings[0][0]; };
    EXPECT_EQ(corner(1), corner(1));
    EXPECT_NE(corner(1), corner(2));
    EXPECT_LT(generate_town({.radius_m = 200.0}).size(), 250u);
}

}  // namespace
}  // namespace data
