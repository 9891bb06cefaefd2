// `still --geometry`: the terrain in the PLY has no T-junction and no hole that the picture shows, judged from the
// file, the raster and the camera alone; and the judge finds every fault that is made on purpose.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/sim/drawn_surface.h"
#include "tests/sim/program.h"

namespace {

using sim_test::DrawnSurface;
using sim_test::Face;
using sim_test::SurfaceFaults;
using sim_test::TriangleMesh;

struct Camera {
    double lon_deg, lat_deg, height_m, heading_deg, pitch_deg, roll_deg;

    std::string text() const {
        std::string words;
        for (double number : {lon_deg, lat_deg, height_m, heading_deg, pitch_deg, roll_deg})
            words += (words.empty() ? "" : ",") + std::to_string(number);
        return words;
    }
    lod::View view() const {
        using terrain_test::radians;
        lod::View view;
        std::vector<double> m(9);
        GeographicLib::Geocentric::WGS84().Forward(lat_deg, lon_deg, height_m, view.eye_world.x,
                                                   view.eye_world.y, view.eye_world.z, m);
        const glm::dmat3 world_from_enu({m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]});
        view.eye_from_world = lod::eye_from_attitude(world_from_enu, radians(heading_deg), radians(pitch_deg),
                                                     radians(roll_deg));
        view.fov_y_rad = radians(60.0);
        view.width_px = 1280;
        view.height_px = 720;
        return view;
    }
};

constexpr Camera kAlongTheRidge{-84.30, 36.55, 900.0, 40.0, -6.0, 0.0};
constexpr Camera kSteep{-84.25, 36.60, 4000.0, 200.0, -60.0, 25.0};

/// Removes a vertex from one side of an edge: two triangles that meet in the middle of a long edge become one. Only
/// where the vertex stays in use on the other side.
bool make_t_junction(const DrawnSurface& surface, TriangleMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, size_t> face_of;
    for (size_t i = 0; i < mesh.faces.size(); ++i) {
        for (size_t corner = 0; corner < 3; ++corner)
            face_of[{mesh.faces[i][corner], mesh.faces[i][(corner + 1) % 3]}] = i;
    }
    const auto third = [&](size_t face, uint32_t a, uint32_t b) {
        for (const uint32_t corner : mesh.faces[face]) {
            if (corner != a && corner != b) return corner;
        }
        return a;
    };
    for (const auto& [edge, face] : face_of) {
        const auto [middle, top] = edge;
        const auto other = face_of.find({top, middle});
        if (other == face_of.end()) continue;
        const uint32_t a = third(other->second, top, middle), b = third(face, middle, top);
        const bool is_between =
            glm::distance(surface.plan(a) + surface.plan(b), 2.0 * surface.plan(middle)) < 1e-3;
        const bool is_inner = face_of.count({a, middle}) + face_of.count({middle, a}) == 2;
        if (!is_between || !is_inner) continue;
        mesh.faces[face] = {a, top, b};
        mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(other->second));
        mesh.module.pop_back();
        return true;
    }
    return false;
}

class StillGeometry : public testing::TestWithParam<double> {
  protected:
    void SetUp() override {
        if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
        ASSERT_TRUE(terrain_test::read_truth(HARRIER_SOURCE_DIR "/data/samples/jacksboro.tif", dem_));
    }

    /// The terrain's part of the default scene, as `still --geometry` writes it.
    TriangleMesh terrain_of(const Camera& camera) const {
        const sim_test::TempFolder folder;
        const auto outcome =
            sim_test::run_program(folder, "still " HARRIER_SOURCE_DIR
                                          "/data/samples/jacksboro.toml --size 1280x720 --fov 60"
                                          " --camera=" +
                                              camera.text() + " --tolerance " + std::to_string(GetParam()) +
                                              " --geometry " + folder.file("drawn.ply"));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        TriangleMesh mesh = sim_test::read_ply(folder.file("drawn.ply"));
        const auto said = nlohmann::json::parse(outcome.out);
        EXPECT_TRUE(said["converged"].get<bool>());
        EXPECT_EQ(static_cast<size_t>(std::count(mesh.module.begin(), mesh.module.end(), 0)),
                  said["triangles"]["terrain"].get<size_t>());
        return only_terrain(mesh);
    }

    static TriangleMesh only_terrain(const TriangleMesh& all) {
        TriangleMesh terrain;
        std::map<uint32_t, uint32_t> index_of;
        for (size_t i = 0; i < all.faces.size(); ++i) {
            if (all.module[i] != 0) continue;
            Face face = all.faces[i];
            for (uint32_t& corner : face) {
                const auto [place, is_new] =
                    index_of.emplace(corner, static_cast<uint32_t>(terrain.vertices.size()));
                if (is_new) terrain.vertices.push_back(all.vertices[corner]);
                corner = place->second;
            }
            terrain.faces.push_back(face);
            terrain.module.push_back(0);
        }
        return terrain;
    }

    SurfaceFaults judge(const TriangleMesh& mesh, const Camera& camera) const {
        return DrawnSurface(mesh, dem_).judge(camera.view());
    }

    /// Some face whose corners are all well inside the picture.
    size_t face_in_picture(const TriangleMesh& mesh, const Camera& camera) const {
        const lod::View view = camera.view();
        for (size_t i = mesh.faces.size() / 2; i < mesh.faces.size(); ++i) {
            const Face& face = mesh.faces[i];
            if (std::all_of(face.begin(), face.end(), [&](uint32_t corner) {
                    return terrain_test::is_in_picture(view,
                                                       terrain_test::projected(view, mesh.vertices[corner]));
                }))
                return i;
        }
        ADD_FAILURE() << "no face in the picture";
        return 0;
    }

    terrain_test::DemTruth dem_;
};

TEST_P(StillGeometry, HasNoTJunctionAndNoHole) {
    for (const Camera& camera : {kAlongTheRidge, kSteep}) {
        const TriangleMesh mesh = terrain_of(camera);
        ASSERT_GT(mesh.faces.size(), 100u);
        const SurfaceFaults faults = judge(mesh, camera);
        EXPECT_EQ(faults.off_samples, 0u);
        EXPECT_EQ(faults.twins, 0u);
        EXPECT_EQ(faults.within_edges, 0u);
        EXPECT_EQ(faults.overused_edges, 0u);
        EXPECT_EQ(faults.facing_down, 0u);
        EXPECT_EQ(faults.open_in_picture, 0u);
    }
}

TEST_P(StillGeometry, TheJudgeFindsADisplacedVertex) {
    TriangleMesh mesh = terrain_of(kAlongTheRidge);
    const size_t face = face_in_picture(mesh, kAlongTheRidge);
    const uint32_t vertex = mesh.faces[face][0];
    mesh.vertices[vertex] *= 1.0 + 1e-8;  // 6 cm up
    EXPECT_EQ(judge(mesh, kAlongTheRidge).off_samples, 1u);
    // In one triangle only: a crack.
    mesh = terrain_of(kAlongTheRidge);
    mesh.vertices.push_back(mesh.vertices[vertex] * (1.0 + 1e-8));
    mesh.faces[face][0] = static_cast<uint32_t>(mesh.vertices.size() - 1);
    const SurfaceFaults cracked = judge(mesh, kAlongTheRidge);
    EXPECT_EQ(cracked.twins, 2u);
    EXPECT_GE(cracked.open_in_picture, 2u);
}

TEST_P(StillGeometry, TheJudgeFindsARemovedVertex) {
    TriangleMesh mesh = terrain_of(kAlongTheRidge);
    const TriangleMesh whole = mesh;
    ASSERT_TRUE(make_t_junction(DrawnSurface(whole, dem_), mesh));
    const SurfaceFaults faults = judge(mesh, kAlongTheRidge);
    EXPECT_EQ(faults.within_edges, 1u);
    EXPECT_EQ(faults.off_samples + faults.twins + faults.overused_edges + faults.facing_down, 0u);
}

TEST_P(StillGeometry, TheJudgeFindsMissingAndDoubledTriangles) {
    const TriangleMesh whole = terrain_of(kAlongTheRidge);
    const size_t face = face_in_picture(whole, kAlongTheRidge);
    TriangleMesh mesh = whole;
    mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(face));
    EXPECT_GE(judge(mesh, kAlongTheRidge).open_in_picture, 1u);
    mesh = whole;
    mesh.faces.push_back(whole.faces[face]);
    EXPECT_EQ(judge(mesh, kAlongTheRidge).overused_edges, 3u);
    mesh = whole;
    std::swap(mesh.faces[face][0], mesh.faces[face][1]);
    EXPECT_EQ(judge(mesh, kAlongTheRidge).facing_down, 1u);
}

INSTANTIATE_TEST_SUITE_P(Tolerances, StillGeometry, testing::Values(1.0, 4.0),
                         [](const testing::TestParamInfo<double>& tolerance) {
                             return std::to_string(static_cast<int>(tolerance.param)) + "px";
                         });

}  // namespace
