#include "data/world_frame.h"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "lod/base/rng.h"

namespace {

using data::SitePoint;
using data::WorldFrame;

// The textbook formula, independent of the library behind the code.
glm::dvec3 ecef_by_formula(const SitePoint& site) {
    const long double a = 6378137.0L, f = 1.0L / 298.257223563L, e2 = f * (2.0L - f);
    const long double degree = 3.14159265358979323846264338327950288L / 180.0L;
    const long double phi = site.y * degree, lambda = site.x * degree;
    const long double n = a / sqrtl(1.0L - e2 * sinl(phi) * sinl(phi)), h = site.height_m;
    return {static_cast<double>((n + h) * cosl(phi) * cosl(lambda)),
            static_cast<double>((n + h) * cosl(phi) * sinl(lambda)),
            static_cast<double>((n * (1.0L - e2) + h) * sinl(phi))};
}

TEST(WorldFrame, AgreesWithTheFormulaAndRoundTrips) {
    lod::Rng rng(1);
    const WorldFrame frame;
    for (int i = 0; i < 2000; ++i) {
        const SitePoint site{rng.between(-180, 180), rng.between(-90, 90), rng.between(-500, 100'000)};
        const glm::dvec3 world = frame.world_from_site(site);
        ASSERT_LT(glm::distance(world, ecef_by_formula(site)), 1e-8);
        const SitePoint back = frame.site_from_world(world);
        ASSERT_LT(glm::distance(frame.world_from_site(back), world), 1e-8);
        ASSERT_NEAR(back.height_m, site.height_m, 1e-8);
    }
}

TEST(WorldFrame, KnowsTheAxes) {
    const WorldFrame frame;
    EXPECT_EQ(frame.world_from_site({0, 0, 0}), glm::dvec3(6378137.0, 0, 0));
    EXPECT_NEAR(frame.world_from_site({0, 90, 0}).z, 6356752.314245179, 1e-8);
    EXPECT_EQ(frame.site_from_world({0, 0, 0}).y, 90.0);
    EXPECT_NEAR(frame.site_from_world({-7e6, 1e-3, 0}).x, 180.0, 1e-6);
}

TEST(WorldFrame, EastNorthUpIsTheLocalFrame) {
    lod::Rng rng(2);
    const WorldFrame frame;
    for (int i = 0; i < 500; ++i) {
        const SitePoint site{rng.between(-180, 180), rng.between(-89.9, 89.9), rng.between(0, 9000)};
        const GeographicLib::LocalCartesian local(site.y, site.x, site.height_m);
        const glm::dvec3 origin = frame.world_from_site(site);
        const glm::dmat3 world_from_enu = frame.world_from_enu(origin);
        for (const glm::dvec3& enu : {glm::dvec3(900, 0, 0), glm::dvec3(0, 900, 0), glm::dvec3(0, 0, 900)}) {
            SitePoint there;
            local.Reverse(enu.x, enu.y, enu.z, there.y, there.x, there.height_m);
            ASSERT_LT(glm::distance(origin + world_from_enu * enu, frame.world_from_site(there)), 1e-6);
        }
    }
}

TEST(WorldFrame, PolesHaveAnEastAlongLongitudeZero) {
    const WorldFrame frame;
    const glm::dmat3 north = frame.world_from_enu({0, 0, 6.4e6});
    EXPECT_LT(glm::distance(north[0], glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::distance(north[1], glm::dvec3(-1, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(north[2], glm::dvec3(0, 0, 1)), 1e-12);
    const glm::dmat3 south = frame.world_from_enu({0, 0, -6.4e6});
    EXPECT_LT(glm::distance(south[0], glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::distance(south[2], glm::dvec3(0, 0, -1)), 1e-12);
}

TEST(WorldFrame, WithoutDatumIsTheSiteItself) {
    const WorldFrame plain{.has_datum = false};
    EXPECT_EQ(plain.world_from_site({1, 2, 3}), glm::dvec3(1, 2, 3));
    EXPECT_EQ(plain.site_from_world({1, 2, 3}).height_m, 3.0);
    EXPECT_EQ(plain.world_from_enu({1, 2, 3}), glm::dmat3(1.0));
}

}  // namespace
