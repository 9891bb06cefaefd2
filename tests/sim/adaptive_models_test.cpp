// Instruments that adapt: drawn in full they are the source, needles included; in flight they are few triangles within
// the tolerance.
#include "sim/adaptive_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/generated_altimeter.h"
#include "lod/scheduler.h"
#include "sim/mesh_model.h"
#include "sim/model_parts.h"
#include "tests/sim/program.h"

namespace {

/// Sums over a surface that tell where it is: area, first and second moments, in the eye frame.
struct Moments {
    double area = 0.0;
    glm::dvec3 first{0.0};
    glm::dmat3 second{0.0};

    void add(const std::array<glm::dvec3, 3>& t) {
        const double a = 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
        const glm::dvec3 c = (t[0] + t[1] + t[2]) / 3.0;
        area += a;
        first += a * c;
        second += a * glm::outerProduct(c, c);
    }
};

/// What the shader makes of an item's vertices.
glm::dvec3 in_eye(const lod::Instance& instance, const lod::Vertex& vertex) {
    glm::dvec3 eye(0.0);
    for (int row = 0; row < 3; ++row) {
        for (int col = 0; col < 3; ++col) {
            eye[row] += double(instance.eye_from_model[row][col]) *
                        (double(vertex.position_hi[col]) - double(instance.origin_hi[col]) +
                         (double(vertex.position_lo[col]) - double(instance.origin_lo[col])));
        }
    }
    return eye;
}

Moments drawn(lod::Front& front, const lod::View& view) {
    lod::PoolRegion region = front.pool_need();
    front.place(region);
    lod::DrawList list;
    front.emit(view, list);
    std::vector<lod::Vertex> vertices(region.vertex_capacity);
    std::vector<uint32_t> indices(region.index_capacity);
    for (const lod::VertexWrite& write : list.vertex_writes)
        std::copy(write.vertices.begin(), write.vertices.end(), vertices.begin() + write.first_vertex);
    for (const lod::IndexWrite& write : list.index_writes)
        std::copy(write.indices.begin(), write.indices.end(), indices.begin() + write.first_index);
    Moments sum;
    for (const lod::DrawItem& item : list.items) {
        for (uint32_t i = 0; i < item.index_count; i += 3) {
            std::array<glm::dvec3, 3> corners;
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t index = indices[item.first_index + i + k];
                corners[k] = in_eye(list.instances[item.instance],
                                    vertices[static_cast<size_t>(item.base_vertex) + index]);
            }
            sum.add(corners);
        }
    }
    return sum;
}

lod::View close_view() {
    lod::View view;
    view.width_px = 1280;
    view.height_px = 720;
    view.near_m = 0.01;
    return view;
}

TEST(AdaptiveModels, InFullAndWithNeedlesTurnedTheyAreTheSource) {
    const data::PolygonMesh mesh = data::generate_altimeter();
    const std::vector<sim::Drive> drives{{"needle_1000", 0}, {"needle_10000", 0}};
    const lod::BodyPose pose = sim::cockpit_pose({0.02, -0.05, -0.4}, 0.3, 1.0);
    sim::Signals signals{};
    signals.value[0] = 1370.0;
    const lod::View view = close_view();

    auto parts = sim::make_model_parts(mesh, pose, drives);
    ASSERT_TRUE(parts) << parts.message();
    sim::move_bodies(parts->moving, signals, parts->bodies);
    lod::RigidFront whole(lod::Module::kInstruments, parts->parts, parts->bodies);
    const Moments expected = drawn(whole, view);

    auto model = sim::build_model(mesh, {}, 2);
    ASSERT_TRUE(model) << model.message();
    sim::AdaptiveModels models;
    models.learn("altimeter", std::move(*model));
    ASSERT_TRUE(models.add("altimeter", pose, drives));
    sim::AdaptiveRig rig;
    const auto front = models.make_front(lod::Module::kInstruments, {}, rig);
    sim::move_bodies(rig.moving, signals, rig.poses);
    sim::pose_bodies(rig, glm::dmat3(1.0), glm::dvec3(0.0), *front);
    lod::Front* fronts[] = {front.get()};
    lod::Budget budget;
    budget.tolerance_px = 0.0;
    front->begin_frame({&view, 1}, 0.0);
    lod::schedule(fronts, budget, lod::operation_limit(UINT64_MAX));
    EXPECT_EQ(front->validate(), "");
    const Moments found = drawn(*front, view);

    EXPECT_NEAR(found.area, expected.area, 1e-5 * expected.area);
    EXPECT_LT(glm::distance(found.first, expected.first), 5e-6 * expected.area);
    for (int col = 0; col < 3; ++col)
        EXPECT_LT(glm::distance(found.second[col], expected.second[col]), 5e-6 * expected.area);

    // Elsewhere the needles would be found elsewhere: the comparison sees them.
    signals.value[0] = 1620.0;
    sim::move_bodies(rig.moving, signals, rig.poses);
    sim::pose_bodies(rig, glm::dmat3(1.0), glm::dvec3(0.0), *front);
    front->begin_frame({&view, 1}, 0.1);
    EXPECT_GT(glm::distance(drawn(*front, view).first, expected.first), 2e-5 * expected.area);
}

TEST(AdaptiveModels, OneSourceInManyPlacesSharesItsMeshes) {
    auto model = sim::build_model(data::generate_altimeter(), {}, 2);
    ASSERT_TRUE(model) << model.message();
    const size_t parts = model->parts.size();
    sim::AdaptiveModels models;
    models.learn("altimeter", std::move(*model));
    for (int i = 0; i < 5; ++i)
        ASSERT_TRUE(models.add("altimeter", sim::cockpit_pose({0.1 * i, 0.0, -0.5}, 0.0, 1.0), {}));
    EXPECT_FALSE(models.add("altimeter", {}, std::vector<sim::Drive>{{"needle_7", 0}}));
    sim::AdaptiveRig rig;
    const auto front = models.make_front(lod::Module::kInstruments, {}, rig);
    EXPECT_EQ(front->body_count(), 5 * parts);
    EXPECT_EQ(&front->body(0).cut().mesh(), &front->body(static_cast<uint32_t>(parts)).cut().mesh());
}

nlohmann::json flown(const std::string& scene, const std::string& options, bool& is_skipped) {
    const sim_test::TempFolder folder;
    const std::string report = folder.file("report.json");
    const sim_test::Outcome outcome =
        sim_test::run_program(folder, "fly " HARRIER_SOURCE_DIR "/data/samples/" + scene + options +
                                          " --glide 0 --report " + report);
    is_skipped = outcome.status != 0 && outcome.err.find("EGL") != std::string::npos;
    if (is_skipped) return {};
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(std::ifstream(report));
}

TEST(AdaptiveModels, TheDemosPanelIsAFewTrianglesWithinTheTolerance) {
    if (!sim_test::has_program()) GTEST_SKIP() << "the program is not built";
    bool is_skipped = false;
    const auto json = flown("jacksboro.toml", " --ops 30000 --triangles 80000 --frames 4", is_skipped);
    if (is_skipped) GTEST_SKIP() << "no EGL here";
    const auto& last = json.at("frames").back();
    const auto triangles = last.at("triangles").at("instruments").get<uint64_t>();
    EXPECT_GT(triangles, 500u);
    EXPECT_LT(triangles, 55'200u / 2) << "of 55,200 in full";
    EXPECT_GT(last.at("error_px").at("instruments").get<double>(), 0.0);
    EXPECT_LE(last.at("error_px").at("instruments").get<double>(), 1.0);
    EXPECT_GT(json.at("frames")[0].at("operations").at("vsplit").get<uint64_t>(), 500u);
}

/// Nine gauges of 156,000 triangles in full, from thirty metres to two kilometres.
TEST(AdaptiveModels, ARowOfGaugesInTheLandscapeCostsWhatIsSeenOfIt) {
    if (!sim_test::has_program()) GTEST_SKIP() << "the program is not built";
    bool is_skipped = false;
    const auto json = flown("instrument_row.toml", " --ops 60000 --triangles 90000 --frames 3", is_skipped);
    if (is_skipped) GTEST_SKIP() << "no EGL here";
    const auto& last = json.at("frames").back();
    EXPECT_GT(last.at("triangles").at("objects").get<uint64_t>(), 2000u);
    EXPECT_LT(last.at("triangles").at("objects").get<uint64_t>(), 156'000u / 3);
    EXPECT_LE(last.at("error_px").at("objects").get<double>(), 1.0);
}

}  // namespace
