#include "lod/draw_list.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lod/base/rng.h"

namespace lod {
namespace {

glm::dvec3 random_point(Rng& rng, double reach) {
    const double x = rng.between(-reach, reach), y = rng.between(-reach, reach),
                 z = rng.between(-reach, reach);
    return {x, y, z};
}

TEST(DrawList, PositionsKeepFortyEightBitsOnEveryAxis) {
    Rng rng(1);
    for (int trial = 0; trial < 1000; ++trial) {
        const glm::dvec3 point = random_point(rng, 6.4e6);
        const glm::dvec3 kept = position_of(make_vertex(point, {0, 0, 1}, {1, 2, 3}, Material::kPaint));
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LE(std::abs(kept[axis] - point[axis]), std::abs(point[axis]) * 0x1p-48) << "axis " << axis;
        }
    }
}

TEST(DrawList, InstancesKeepTheEyeOnEveryAxis) {
    Rng rng(2);
    for (int trial = 0; trial < 1000; ++trial) {
        const glm::dvec3 eye = random_point(rng, 6.4e6);
        const Instance instance = make_world_instance(eye, glm::dmat3(1.0), Module::kTerrain);
        for (int axis = 0; axis < 3; ++axis) {
            const double kept = double(instance.origin_hi[axis]) + double(instance.origin_lo[axis]);
            ASSERT_LE(std::abs(kept - eye[axis]), std::abs(eye[axis]) * 0x1p-48) << "axis " << axis;
        }
    }
}

TEST(DrawList, NormalsComeBackWithinAHundredthOfADegree) {
    Rng rng(3);
    for (int trial = 0; trial < 10000; ++trial) {
        const glm::vec3 normal(glm::normalize(random_point(rng, 1.0)));
        uint16_t packed[2];
        encode_normal(normal, packed);
        const glm::vec3 back = decode_normal(packed);
        ASSERT_LT(glm::distance(normal, back), 1.7e-4f);
    }
}

TEST(DrawList, AxesComeBackExactly) {
    for (const glm::vec3& axis :
         {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
        uint16_t packed[2];
        encode_normal(axis, packed);
        EXPECT_LT(glm::distance(decode_normal(packed), axis), 1e-6f);
    }
}

}  // namespace
}  // namespace lod
