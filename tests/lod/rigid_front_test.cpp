#include "lod/rigid_front.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

#include "lod/base/rng.h"
#include "tests/lod/allocations.h"

namespace {

std::atomic<uint64_t> g_allocations{0};  // the operator below has no other place to count

}  // namespace

void* operator new(size_t bytes) {
    ++g_allocations;
    if (void* memory = std::malloc(bytes)) return memory;
    std::abort();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}

uint64_t lod_test::allocation_count() {
    return g_allocations;
}

namespace lod {
namespace {

constexpr double kEarth = 6.37e6;

glm::dvec3 random_point(Rng& rng, double reach) {
    const double x = rng.between(-reach, reach), y = rng.between(-reach, reach),
                 z = rng.between(-reach, reach);
    return {x, y, z};
}

glm::dmat3 random_rotation(Rng& rng) {
    const glm::dvec3 x = glm::normalize(random_point(rng, 1.0));
    const glm::dvec3 y = glm::normalize(glm::cross(random_point(rng, 1.0), x));
    return {x, y, glm::cross(x, y)};
}

/// One triangle somewhere within `reach` of `centre`.
RigidPart random_triangle(Rng& rng, const glm::dvec3& centre, double reach, double size) {
    RigidPart part;
    const glm::dvec3 place = centre + random_point(rng, reach);
    for (uint32_t corner = 0; corner < 3; ++corner) {
        part.vertices.push_back(
            make_vertex(place + random_point(rng, size), {0, 0, 1}, {200, 200, 200}, Material::kPaint));
        part.indices.push_back(corner);
    }
    return part;
}

View random_view(Rng& rng, const glm::dvec3& centre, double reach) {
    View view;
    view.eye_world = centre + random_point(rng, reach);
    view.eye_from_world = random_rotation(rng);
    view.fov_y_rad = rng.between(0.2, 2.0);
    view.width_px = 1280;
    view.height_px = 720;
    return view;
}

PoolRegion region_for(const Front& front) {
    PoolRegion region = front.pool_need();
    region.first_vertex = 1000;
    region.first_index = 5000;
    return region;
}

/// What the shader does with a vertex.
glm::dvec3 eye_from(const Instance& instance, const Vertex& vertex) {
    glm::dvec3 local, eye(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        local[axis] = (double(vertex.position_hi[axis]) - double(instance.origin_hi[axis])) +
                      (double(vertex.position_lo[axis]) - double(instance.origin_lo[axis]));
    }
    for (int row = 0; row < 3; ++row) {
        for (int col = 0; col < 3; ++col)
            eye[row] += double(instance.eye_from_model[row][col]) * local[col];
    }
    return eye;
}

bool in_picture(const View& view, const glm::dvec3& eye) {
    const double tan_y = std::tan(view.fov_y_rad / 2.0), tan_x = tan_y * view.width_px / view.height_px;
    return -eye.z >= view.near_m && std::abs(eye.x) <= -eye.z * tan_x && std::abs(eye.y) <= -eye.z * tan_y;
}

const DrawItem* item_of(const DrawList& list, uint32_t first_index) {
    for (const DrawItem& item : list.items) {
        if (item.first_index == first_index) return &item;
    }
    return nullptr;
}

TEST(RigidFront, NeverDropsAPartWithAVisibleVertexAndDropsMostOthers) {
    Rng rng(7);
    const glm::dvec3 centre(kEarth, 1000.0, -2000.0);
    std::vector<RigidPart> parts;
    for (int i = 0; i < 400; ++i)
        parts.push_back(random_triangle(rng, centre, 500.0, 10.0));
    const std::vector<RigidPart> kept = parts;
    RigidFront front(Module::kObjects, std::move(parts), {BodyPose{}});
    front.place(region_for(front));
    size_t visible = 0, drawn = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const View view = random_view(rng, centre, 600.0);
        DrawList list;
        front.emit(view, list);
        drawn += list.items.size();
        for (size_t i = 0; i < kept.size(); ++i) {
            bool sees = false;
            for (const Vertex& vertex : kept[i].vertices) {
                sees |= in_picture(view, view.eye_from_world * (position_of(vertex) - view.eye_world));
            }
            if (!sees) continue;
            ++visible;
            ASSERT_NE(item_of(list, 5000 + static_cast<uint32_t>(3 * i)), nullptr) << trial << " part " << i;
        }
    }
    EXPECT_GT(visible, 1000u);
    EXPECT_LT(drawn, visible * 3 / 2);
}

TEST(RigidFront, PlacesBodiesInAllThreeFramesAsTheShaderSeesThem) {
    Rng rng(11);
    const glm::dvec3 ground(kEarth, 0.0, 0.0);
    for (int trial = 0; trial < 200; ++trial) {
        View view = random_view(rng, ground, 50.0);
        const glm::dmat3 turn = random_rotation(rng) * 3.0;
        const glm::dvec3 ahead_eye(0.1, -0.2, -60.0);
        const glm::dvec3 ahead_world = view.eye_world + glm::transpose(view.eye_from_world) * ahead_eye;
        const BodyPose world{};
        const BodyPose placed{BodyPose::Frame::kPlaced, turn, ahead_world};
        const BodyPose cockpit{BodyPose::Frame::kEye, turn, ahead_eye};
        RigidPart part = random_triangle(rng, glm::dvec3(0.0), 0.0, 1.0);
        RigidPart in_world = random_triangle(rng, ahead_world, 0.0, 1.0);
        const Vertex vertex = part.vertices[1], world_vertex = in_world.vertices[1];
        std::vector<RigidPart> parts{in_world, part, part};
        parts[1].body = 1;
        parts[2].body = 2;
        RigidFront front(Module::kInstruments, std::move(parts), {world, placed, cockpit});
        front.place(region_for(front));
        DrawList list;
        front.emit(view, list);
        ASSERT_EQ(list.instances.size(), 3u);
        EXPECT_EQ(list.instances[0].is_world, 1u);
        EXPECT_EQ(list.instances[1].is_world, 0u);
        EXPECT_EQ(list.instances[2].is_world, 0u);
        EXPECT_EQ(list.instances[2].module, static_cast<uint32_t>(Module::kInstruments));
        const glm::dvec3 local = position_of(vertex);
        const glm::dvec3 expected[3] = {view.eye_from_world * (position_of(world_vertex) - view.eye_world),
                                        view.eye_from_world * (turn * local + (ahead_world - view.eye_world)),
                                        turn * local + ahead_eye};
        EXPECT_LT(glm::distance(eye_from(list.instances[0], world_vertex), expected[0]), 2e-5);
        EXPECT_LT(glm::distance(eye_from(list.instances[1], vertex), expected[1]), 2e-5);
        EXPECT_LT(glm::distance(eye_from(list.instances[2], vertex), expected[2]), 2e-5);
        EXPECT_EQ(front.validate(), "");
    }
}

TEST(RigidFront, WritesItsGeometryOnceAfterEachPlace) {
    Rng rng(3);
    std::vector<RigidPart> parts{random_triangle(rng, {0, 0, -50}, 1.0, 1.0),
                                 random_triangle(rng, {0, 0, -50}, 1.0, 1.0)};
    RigidFront front(Module::kObjects, parts, {BodyPose{}});
    const View view;
    for (uint32_t round = 0; round < 2; ++round) {
        PoolRegion region = front.pool_need();
        EXPECT_EQ(region.vertex_capacity, 6u);
        region.first_vertex = 100 * round;
        front.place(region);
        DrawList list;
        front.emit(view, list);
        ASSERT_EQ(list.vertex_writes.size(), 1u);
        ASSERT_EQ(list.index_writes.size(), 1u);
        EXPECT_EQ(list.vertex_writes[0].first_vertex, 100 * round);
        EXPECT_EQ(list.index_writes[0].indices.size(), 6u);
        ASSERT_EQ(list.items.size(), 2u);
        EXPECT_EQ(list.instances.size(), 1u) << "parts of one body share the record";
        const uint32_t pooled = list.index_writes[0].indices[list.items[1].first_index];
        const size_t vertex = static_cast<size_t>(list.items[1].base_vertex) + pooled - 100 * round;
        EXPECT_EQ(position_of(list.vertex_writes[0].vertices[vertex]), position_of(parts[1].vertices[0]));
        list.clear();
        front.emit(view, list);
        EXPECT_TRUE(list.vertex_writes.empty() && list.index_writes.empty());
        EXPECT_EQ(front.emitted_triangles(), 2u);
    }
}

TEST(RigidFront, AllocatesNothingOnceWarm) {
    Rng rng(5);
    std::vector<RigidPart> parts;
    for (int i = 0; i < 100; ++i)
        parts.push_back(random_triangle(rng, glm::dvec3(0.0), 100.0, 5.0));
    RigidFront front(Module::kObjects, std::move(parts), {BodyPose{}});
    front.place(region_for(front));
    DrawList list;
    list.items.reserve(100);
    list.instances.reserve(1);
    front.emit(random_view(rng, glm::dvec3(0.0), 100.0), list);
    const View view = random_view(rng, glm::dvec3(0.0), 100.0);
    const uint64_t before = g_allocations;
    for (int frame = 0; frame < 50; ++frame) {
        list.clear();
        front.begin_frame({&view, 1}, 0.1 * frame);
        front.emit(view, list);
    }
    EXPECT_EQ(g_allocations, before);
}

TEST(RigidFront, KeepsAPartWhoseFootIsLoweredIntoThePicture) {
    const View view;  // looks along -z, +y up
    RigidPart part;
    const double top = std::tan(view.fov_y_rad / 2.0) * 100.0;
    const double px = top / (view.height_px / 2.0);
    for (const glm::dvec3& corner :
         {glm::dvec3(0, 1, -100), glm::dvec3(1, 1, -100), glm::dvec3(0, 2, -100)}) {
        part.vertices.push_back(
            make_vertex(corner + glm::dvec3(0, top + px, 0), {0, 0, 1}, {9, 9, 9}, Material::kWallFoot));
    }
    part.indices = {0, 1, 2};
    RigidFront front(Module::kObjects, {part}, {BodyPose{}});
    front.place(region_for(front));
    DrawList list;
    front.emit(view, list);
    EXPECT_TRUE(list.items.empty());
    front.set_ground_error_px(10.0);
    front.set_up_world({0.0, 3.0, 0.0});
    front.emit(view, list);
    ASSERT_EQ(list.items.size(), 1u);
    EXPECT_FLOAT_EQ(list.instances[0].up_eye[1], 1.0f);
    EXPECT_FLOAT_EQ(list.instances[0].up_eye[3], 10.0f);
}

TEST(RigidFront, OffersNothingToTheScheduler) {
    RigidFront front(Module::kObjects, {}, {});
    EXPECT_EQ(front.refine_error_px(), 0.0);
    EXPECT_TRUE(std::isinf(front.coarsen_error_px()));
    EXPECT_EQ(front.coarsen(1e30).steps, 0u);
    DrawList list;
    front.emit(View{}, list);
    EXPECT_TRUE(list.items.empty());
}

TEST(RigidFront, ValidateNamesABadPose) {
    Rng rng(9);
    RigidFront front(Module::kObjects, {random_triangle(rng, glm::dvec3(0.0), 1.0, 1.0)}, {BodyPose{}});
    EXPECT_EQ(front.validate(), "");
    const uint64_t hash = front.hash();
    front.set_pose(0, {BodyPose::Frame::kPlaced, glm::dmat3(1, 0, 0, 0, 2, 0, 0, 0, 1), glm::dvec3(0.0)});
    EXPECT_NE(front.validate().find("body 0"), std::string::npos);
    EXPECT_EQ(front.hash(), hash);
}

}  // namespace
}  // namespace lod
