// Models cut at every kilobyte: refused in one line. OBJ, which does not state its length, may be smaller by whole
// lines, and what it still has is right.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

#include "tests/data/cut_files.h"
#include "tests/data/raster_writer.h"
#include "tests/data/small_models.h"

namespace {

using test::CutFolder;
using test::CutOutcome;

/// @param part  the file to cut, where it is not the one that is opened
CutOutcome cut_model(const std::string& path, size_t step_bytes = 1024, const std::string& part = "") {
    const auto whole = data::read_polygon_mesh(path);
    EXPECT_TRUE(whole) << whole.message();
    if (!whole) return {};
    test::check_promises(*whole);
    return test::cut_down(
        part.empty() ? path : part, std::filesystem::path(path).filename().string(),
        [&]() -> std::optional<std::string> {
            const auto mesh = data::read_polygon_mesh(path);
            if (!mesh) return mesh.message();
            test::check_promises(*mesh);
            return std::nullopt;
        },
        step_bytes);
}

constexpr std::array<size_t, 6> kTwoTriangles{0, 1, 2, 0, 2, 3};

/// A grid of quads in plan: points in rows, four corners a face, from 0.
struct QuadGrid {
    std::vector<glm::vec3> points;
    std::vector<std::array<uint32_t, 4>> faces;
};

QuadGrid quad_grid(uint32_t size) {
    QuadGrid grid;
    for (uint32_t i = 0; i <= size; ++i) {
        for (uint32_t k = 0; k <= size; ++k)
            grid.points.emplace_back(i, k, (i * k) % 3);
    }
    for (uint32_t i = 0; i < size; ++i) {
        for (uint32_t k = 0; k < size; ++k) {
            const uint32_t corner = i * (size + 1) + k;
            grid.faces.push_back({corner, corner + size + 1, corner + size + 2, corner + 1});
        }
    }
    return grid;
}

std::string obj_of(const QuadGrid& grid) {
    std::ostringstream text;
    for (const glm::vec3& p : grid.points)
        text << "v " << p.x << " " << p.y << " " << p.z << "\n";
    for (const auto& face : grid.faces)
        text << "f " << face[0] + 1 << " " << face[1] + 1 << " " << face[2] + 1 << " " << face[3] + 1 << "\n";
    return text.str();
}

std::string ply_header(const QuadGrid& grid, const std::string& format) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(grid.points.size()) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(grid.faces.size()) + "\nproperty list uchar int vertex_index\nend_header\n";
}

std::string text_ply_of(const QuadGrid& grid) {
    std::ostringstream text;
    text << ply_header(grid, "ascii");
    for (const glm::vec3& p : grid.points)
        text << p.x << " " << p.y << " " << p.z << "\n";
    for (const auto& face : grid.faces)
        text << "4 " << face[0] << " " << face[1] << " " << face[2] << " " << face[3] << "\n";
    return text.str();
}

std::string binary_ply_of(const QuadGrid& grid) {
    std::string bytes = ply_header(grid, "binary_little_endian") + test::bytes_of(grid.points);
    for (const auto& face : grid.faces)
        bytes += '\4' + test::bytes_of(face.data(), sizeof(face));
    return bytes;
}

std::vector<glm::vec3> corners_of(const QuadGrid& grid) {
    std::vector<glm::vec3> corners;
    for (const auto& face : grid.faces) {
        for (const size_t corner : kTwoTriangles)
            corners.push_back(grid.points[face[corner]]);
    }
    return corners;
}

std::string text_stl_of(const QuadGrid& grid) {
    std::ostringstream text;
    const std::vector<glm::vec3> corners = corners_of(grid);
    text << "solid grid\n";
    for (size_t i = 0; i < corners.size(); ++i) {
        if (i % 3 == 0) text << "facet normal 0 0 1\nouter loop\n";
        text << "vertex " << corners[i].x << " " << corners[i].y << " " << corners[i].z << "\n";
        if (i % 3 == 2) text << "endloop\nendfacet\n";
    }
    text << "endsolid grid\n";
    return text.str();
}

std::string ac3d_of(const QuadGrid& grid) {
    std::ostringstream text;
    text << "AC3Db\nMATERIAL \"m\" rgb 1 0 0 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
         << "OBJECT world\nkids 1\nOBJECT poly\ndata 12\nOBJECT poly\n\nnumvert " << grid.points.size()
         << "\n";
    for (const glm::vec3& p : grid.points)
        text << p.x << " " << p.y << " " << p.z << "\n";
    text << "numsurf " << grid.faces.size() << "\n";
    for (const auto& face : grid.faces) {
        text << "SURF 0x20\nmat 0\nrefs 4\n";
        for (const uint32_t corner : face)
            text << corner << " 0 0\n";
    }
    text << "kids 0\n";
    return text.str();
}

/// glTF whose buffer is elsewhere.
std::string gltf_of(const QuadGrid& grid, const std::string& buffer_uri) {
    const size_t points = grid.points.size(), corners = 6 * grid.faces.size();
    std::ostringstream text;
    text << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
         << R"({"bufferView":0,"componentType":5126,"count":)" << points
         << R"(,"type":"VEC3","min":[0,0,0],"max":[999,999,2]},)"
         << R"({"bufferView":1,"componentType":5125,"count":)" << corners << R"(,"type":"SCALAR"}],)"
         << R"("bufferViews":[{"buffer":0,"byteLength":)" << 12 * points << R"(},{"buffer":0,"byteOffset":)"
         << 12 * points << R"(,"byteLength":)" << 4 * corners << R"(}],"buffers":[{"byteLength":)"
         << 12 * points + 4 * corners << R"(,"uri":")" << buffer_uri << R"("}]})";
    return text.str();
}

std::string gltf_buffer_of(const QuadGrid& grid) {
    std::string bytes = test::bytes_of(grid.points);
    for (const auto& face : grid.faces) {
        for (const size_t corner : kTwoTriangles)
            bytes += test::word(face[corner]);
    }
    return bytes;
}

void write(const std::string& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
}

TEST(CutModels, FormatsThatStateTheirEndAreRefused) {
    const QuadGrid grid = quad_grid(40);
    struct Case {
        std::string name, content;
    };
    const Case cases[] = {{"grid.ac", ac3d_of(grid)},
                          {"text.ply", text_ply_of(grid)},
                          {"binary.ply", binary_ply_of(grid)},
                          {"text.stl", text_stl_of(grid)},
                          {"binary.stl", test::binary_stl(corners_of(grid))}};
    for (const Case& item : cases) {
        SCOPED_TRACE(item.name);
        const CutFolder folder;
        // A step that meets every place in a line or record, and a whole kilobyte.
        for (const size_t step : {size_t{1024}, size_t{997}}) {
            write(folder.file(item.name), item.content);
            const CutOutcome outcome = cut_model(folder.file(item.name), step);
            EXPECT_GT(outcome.refused, 30u);
            EXPECT_TRUE(outcome.read_at.empty()) << outcome.read_at.front();
        }
    }
}

/// The last bytes one by one: where a count or an index may lose digits.
TEST(CutModels, EndsAreCutByteByByte) {
    const QuadGrid grid = quad_grid(12);
    for (const auto& [name, content] :
         std::vector<std::pair<std::string, std::string>>{{"grid.ac", ac3d_of(grid)},
                                                          {"text.ply", text_ply_of(grid)},
                                                          {"binary.ply", binary_ply_of(grid)},
                                                          {"grid.obj", obj_of(grid)},
                                                          {"small.glb", test::glb()}}) {
        const CutFolder folder;
        const std::string path = folder.file(name);
        write(path, content);
        const auto whole = data::read_polygon_mesh(path);
        ASSERT_TRUE(whole) << whole.message();
        for (size_t lost = 1; lost < 120; ++lost) {
            write(path, content.substr(0, content.size() - lost));
            const auto mesh = data::read_polygon_mesh(path);
            if (!mesh) continue;
            const bool is_all_there = mesh->triangle_count() == whole->triangle_count() && lost == 1;
            const bool is_whole_lines = name == "grid.obj" && content[content.size() - lost - 1] == '\n';
            EXPECT_TRUE(is_all_there || is_whole_lines) << name << " without its last " << lost;
        }
    }
}

TEST(CutModels, GltfAndItsBuffer) {
    const QuadGrid grid = quad_grid(60);
    const CutFolder folder;
    const std::string path = folder.file("grid.gltf"), buffer = folder.file("grid.bin");
    for (const bool is_buffer : {true, false}) {
        write(buffer, gltf_buffer_of(grid));
        write(path, gltf_of(grid, "grid.bin"));
        const CutOutcome outcome = is_buffer ? cut_model(path, 1024, buffer) : cut_model(path, 16);
        EXPECT_GT(outcome.refused, 20u);
        EXPECT_TRUE(outcome.read_at.empty()) << outcome.read_at.front();
    }
}

TEST(CutModels, LinesOfObjAreWholeOrNotThere) {
    const QuadGrid grid = quad_grid(60);
    const std::string content = obj_of(grid);
    const CutFolder folder;
    const std::string path = folder.file("grid.obj");
    write(path, content);
    const CutOutcome outcome = cut_model(path);
    EXPECT_GT(outcome.refused, 80u);
    for (const size_t length : outcome.read_at)
        EXPECT_EQ(content[length - 1], '\n') << length;
    // Cut between two lines it is a smaller model, and valid: its quads are the first of the whole.
    const size_t middle = content.find('\n', content.find('f') + 20'000) + 1;
    write(path, content.substr(0, middle));
    const auto mesh = data::read_polygon_mesh(path);
    ASSERT_TRUE(mesh) << mesh.message();
    const std::string faces = content.substr(0, middle).substr(content.find('f'));
    EXPECT_EQ(mesh->triangle_count(), 2u * static_cast<size_t>(std::count(faces.begin(), faces.end(), '\n')));
}

TEST(CutModels, RealFiles) {
    if (!test::exists(test::real_data("city"))) GTEST_SKIP() << "no shared/data beside the project";
    const std::string panel = "instruments/c172p/Panel_Instruments/";
    for (const std::string& name :
         {std::string("city/tower_crane.glb"), std::string("city/tracked_crane.glb"),
          std::string("city/Crane-100m.ac"), panel + "oat/oat.ac", panel + "alt/alt.ac", panel + "AI/AI.ac",
          panel + "vac/vac.ac", panel + "FuelOilAmps/c172oil.ac",
          std::string("instruments/winter-alti-4110/winter-4110.ac"),
          std::string("instruments/ADIS16480.STL"), std::string("instruments/motor.stl.gz")}) {
        SCOPED_TRACE(name);
        const CutFolder folder;
        EXPECT_TRUE(cut_model(folder.copy(test::real_data(name))).read_at.empty());
    }
}

/// A texture that is cut is a missing one: counted, and the model drawn in its material's colour.
TEST(CutModels, CutTexturesAreCounted) {
    const std::string crane = test::real_data("city/Crane-100m.ac");
    if (!test::exists(crane)) GTEST_SKIP() << "no shared/data beside the project";
    const CutFolder folder;
    const std::string model = folder.copy(crane),
                      texture = folder.copy(test::real_data("city/Crane-100m.png"));
    data::PolygonMeshStats stats;
    const auto whole = data::read_polygon_mesh(model, &stats);
    ASSERT_TRUE(whole) << whole.message();
    EXPECT_TRUE(stats.missing_files.empty());
    for (const size_t length : std::array<size_t, 4>{60'000, 30'000, 1024, 0}) {
        std::filesystem::resize_file(texture, length);
        const auto mesh = data::read_polygon_mesh(model, &stats);
        ASSERT_TRUE(mesh) << mesh.message();
        EXPECT_EQ(mesh->triangle_count(), whole->triangle_count());
        EXPECT_EQ(stats.missing_files, std::vector<std::string>{"Crane-100m.png"}) << length;
    }
}

}  // namespace
