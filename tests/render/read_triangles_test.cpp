#include <gtest/gtest.h>

#include "lod/base/rng.h"
#include "render/drawn_triangles.h"
#include "tests/render/scene_kit.h"

namespace {

using namespace render_test;

glm::dvec3 random_point(double reach, lod::Rng& rng) {
    return {rng.between(-reach, reach), rng.between(-reach, reach), rng.between(-reach, reach)};
}

TEST_F(RendererTest, WorldTrianglesComeBackToTheBit) {
    RENDERER_OR_SKIP(renderer, 32, 32);
    lod::Rng rng(5);
    const lod::View view = lod::look_at({4.5e6, 1e6, 4.4e6}, {0, 0, 0}, {0, 0, 1}, view_of_size(32, 32));
    Scene scene;
    for (int i = 0; i < 100; ++i) {
        add_triangle({random_point(7e6, rng), random_point(7e6, rng), random_point(7e6, rng)}, {}, scene);
    }
    draw(view, render::Atmosphere{}, scene, renderer);
    const auto drawn = renderer.read_triangles(view);
    ASSERT_EQ(drawn.world.size(), 100u) << "the sky is not a triangle of the scene";
    ASSERT_EQ(drawn.module.size(), 100u);
    for (size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(drawn.module[i], lod::Module::kTerrain);
        for (size_t corner = 0; corner < 3; ++corner) {
            EXPECT_EQ(drawn.world[i][corner], lod::position_of(scene.vertices[3 * i + corner]));
        }
    }
}

TEST_F(RendererTest, ModelTrianglesComeBackWhereTheyStand) {
    RENDERER_OR_SKIP(renderer, 32, 32);
    const glm::dvec3 origin(4.5e6, 1e6, 4.4e6);
    const lod::View view =
        lod::look_at(origin + glm::dvec3(20, 5, 9), origin, {0, 0, 1}, view_of_size(32, 32));
    const glm::dmat3 turned = lod::eye_from_attitude(glm::dmat3(1.0), 0.3, 0.2, 0.1) * 2.0;
    Scene scene;
    const std::array<glm::dvec3, 3> model{glm::dvec3(1, 0, 0), {0, 3, 0}, {0, 0, -2}};
    add_triangle(model, {}, scene);
    prepare(view, scene);
    scene.list.instances[0] =
        lod::make_instance(view.eye_world, view.eye_from_world, origin, turned, lod::Module::kInstruments);
    renderer.draw(view, scene.list, vacuum());
    const auto drawn = renderer.read_triangles(view);
    ASSERT_EQ(drawn.world.size(), 1u);
    EXPECT_EQ(drawn.module[0], lod::Module::kInstruments);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(drawn.world[0][i] - (origin + turned * model[i])), 1e-5);
    }
}

TEST_F(RendererTest, WallFeetAreLoweredByTheGroundsErrorInPixels) {
    RENDERER_OR_SKIP(renderer, 64, 64);
    const lod::View view =
        lod::look_at({1e6, 2e6, 3e6}, {1e6, 2e6 + 9, 3e6}, {0, 0, 1}, view_of_size(64, 64));
    for (const double depth_m : {5.0, 500.0}) {
        Scene scene;
        add_quad(rectangle(view, {-20, 0}, {20, 20}, depth_m), {.material = lod::Material::kWallFoot}, scene);
        for (lod::Vertex& vertex : scene.vertices) {
            const bool is_top = project(view, lod::position_of(vertex)).y < 31.0;
            if (is_top) vertex.colour[3] = static_cast<uint8_t>(lod::Material::kGlow);
        }
        prepare(view, scene);
        const glm::dvec3 up_eye = view.eye_from_world * glm::dvec3(0, 0, 1);
        for (int i = 0; i < 3; ++i)
            scene.list.instances[0].up_eye[i] = static_cast<float>(up_eye[i]);
        scene.list.instances[0].up_eye[3] = 10.0f;
        renderer.draw(view, scene.list, vacuum());

        const auto depth = renderer.read_depth();
        EXPECT_FALSE(std::isinf(depth_at(depth, 32, 41))) << "10 px below the middle is wall now";
        EXPECT_TRUE(std::isinf(depth_at(depth, 32, 42)));
        double lowest_px = 0;
        for (const auto& triangle : renderer.read_triangles(view).world) {
            for (const glm::dvec3& corner : triangle)
                lowest_px = std::max(lowest_px, project(view, corner).y);
        }
        EXPECT_NEAR(lowest_px, 42.0, 0.01) << "the geometry read back is the geometry drawn";
    }
}

TEST(DrawnTriangles, FollowsBaseVertexAndDrawingOrder) {
    const std::vector<render::DrawCommand> commands{
        {.index_count = 3, .instance_count = 1, .first_index = 3, .base_vertex = 2, .base_instance = 1},
        {.index_count = 3, .instance_count = 1, .first_index = 0, .base_vertex = 0, .base_instance = 0}};
    std::vector<lod::Instance> instances(2);
    instances[1].module = static_cast<uint32_t>(lod::Module::kObjects);
    std::vector<lod::Vertex> vertices;
    for (int i = 0; i < 5; ++i) {
        vertices.push_back(lod::make_vertex(glm::dvec3(i, 0, 0), {0, 0, 1}, {0, 0, 0}, lod::Material::kGlow));
    }
    const std::vector<uint32_t> indices{0, 1, 2, 2, 1, 0};
    const auto drawn = render::triangles_of({commands, instances, vertices, indices}, lod::View{});
    ASSERT_EQ(drawn.world.size(), 2u);
    EXPECT_EQ(drawn.world[0][0].x, 4.0);
    EXPECT_EQ(drawn.world[0][2].x, 2.0);
    EXPECT_EQ(drawn.module[0], lod::Module::kObjects);
    EXPECT_EQ(drawn.world[1][0].x, 0.0);
    EXPECT_EQ(drawn.module[1], lod::Module::kTerrain);
}

}  // namespace
