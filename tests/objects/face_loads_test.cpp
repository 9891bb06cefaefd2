// What each of a few faces stands for: all of a surface, each piece as near as asked.
#include "objects/reduction/face_loads.h"

#include <gtest/gtest.h>

#include "objects/reduction/stand_in.h"
#include "tests/objects/prisms.h"

namespace {

using objects::FaceLoad;
using objects::FaceSoup;
using objects_test::prism;

double area_m2(const FaceSoup& soup) {
    double sum_m2 = 0.0;
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        const lod::Triangle t = soup.view().triangle(face);
        sum_m2 += 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
    }
    return sum_m2;
}

TEST(FaceLoads, AllOfASurfaceIsSharedOutAndNearAtEveryCorner) {
    for (const auto& [limit_m, count] : {std::pair(3.6, 1u), {2.75, 2u}, {1.9, 5u}}) {
        const FaceSoup tower = prism(104, 3.25, 12.0);
        const FaceSoup faces = objects::stand_in(tower, limit_m).to_gather;
        ASSERT_EQ(faces.faces.size(), count);
        const std::vector<FaceLoad> loads = objects::share_out(tower, faces, limit_m);
        ASSERT_EQ(loads.size(), count);
        double shared_m2 = 0.0;
        for (const FaceLoad& load : loads) {
            shared_m2 += load.outlook.area_m2;
            EXPECT_GT(load.corners.size(), 20u);
            for (const glm::dvec3& corner : load.corners)
                EXPECT_LE(lod::squared_distance(corner, load.face), limit_m * limit_m);
        }
        EXPECT_NEAR(shared_m2, area_m2(tower), 1e-9 * shared_m2);
    }
}

TEST(FaceLoads, NoneWhereThePiecesAreTooFar) {
    const FaceSoup tower = prism(104, 3.25, 12.0);
    const FaceSoup faces = objects::stand_in(tower, 3.6).to_gather;
    EXPECT_TRUE(objects::share_out(tower, faces, 2.0).empty());
}

}  // namespace
