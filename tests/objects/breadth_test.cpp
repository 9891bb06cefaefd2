// What is thin covers about as much when it is reduced as before, seen from any side; counted by rays.
#include <gtest/gtest.h>

#include <cmath>

#include "objects/reduction/reduce.h"
#include "tests/objects/boxes.h"

namespace {

using objects::FaceSoup;

/// Whether a level ray through (across, height), seen under a heading, meets a face.
bool is_hit(const FaceSoup& soup, double heading, double across, double height) {
    const auto seen = [&](const glm::dvec3& p) {
        return glm::dvec2(p.y * std::cos(heading) - p.x * std::sin(heading) - across, p.z - height);
    };
    const auto side = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        const lod::Triangle t = soup.view().triangle(face);
        const glm::dvec2 a = seen(t.a), b = seen(t.b), c = seen(t.c);
        const double ab = side(a, b), bc = side(b, c), ca = side(c, a);
        if ((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0)) return true;
    }
    return false;
}

/// Share of rays through a screen around a mast of 60 m.
double covered(const FaceSoup& soup, double heading) {
    constexpr int kColumns = 30, kRows = 75;
    int hits = 0;
    for (int x = 0; x < kColumns; ++x) {
        for (int z = 0; z < kRows; ++z)
            hits += is_hit(soup, heading, -3.0 + 6.0 * (x + 0.37) / kColumns, 60.0 * (z + 0.41) / kRows);
    }
    return double(hits) / (kColumns * kRows);
}

FaceSoup mast_of_boxes() {
    FaceSoup mast;
    for (int section = 0; section < 10; ++section)
        objects_test::add_box({-0.6, -0.6, 6.0 * section}, {0.6, 0.6, 6.0 * section + 5.9},
                              {200, 160, 0, 255}, mast);
    return mast;
}

TEST(Breadth, AMastIsSeenFromEverySide) {
    const FaceSoup mast = mast_of_boxes();
    for (double limit_m : {2.0, 4.0, 8.0}) {
        const FaceSoup reduced = objects::reduce_within(mast, limit_m);
        EXPECT_LE(reduced.faces.size() * 4, mast.faces.size());
        double mean = 0.0, before = 0.0;
        for (int i = 0; i < 12; ++i) {
            const double heading = 3.14159265 * (i + 0.3) / 12;
            const double share = covered(reduced, heading) / covered(mast, heading);
            EXPECT_GT(share, 0.4) << "limit " << limit_m << " heading " << heading;
            mean += covered(reduced, heading);
            before += covered(mast, heading);
        }
        EXPECT_NEAR(mean / before, 1.0, 0.3) << "limit " << limit_m;
    }
}

}  // namespace
