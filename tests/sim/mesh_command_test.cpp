// `mesh build`, `extract`, `inspect` and `generate`, from outside: files in, files and JSON out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/sim/instrument_files.h"
#include "tests/sim/ply_reader.h"
#include "tests/sim/program.h"

namespace {

using nlohmann::json;
using sim_test::run_program;
using sim_test::TempFolder;
using sim_test::TriangleMesh;

/// A dome over a square of 9 x 9 vertices, in Wavefront OBJ: quads, so that it is triangulated.
std::string dome() {
    std::string text;
    for (int row = 0; row < 9; ++row)
        for (int col = 0; col < 9; ++col)
            text += "v " + std::to_string(10 + col) + " " + std::to_string(row - 40) + " " +
                    std::to_string(5.0 - 0.1 * (std::pow(col - 4, 2) + std::pow(row - 4, 2))) + "\n";
    for (int row = 0; row < 8; ++row)
        for (int col = 0; col < 8; ++col) {
            const int a = 1 + 9 * row + col;
            text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 10) +
                    " " + std::to_string(a + 9) + "\n";
        }
    return text;
}

/// One object of three vertices and a place of its own, in AC3D, whose y is up.
const char* kAc3d =
    "AC3Db\nMATERIAL \"m\" rgb 0.5 0.5 0.5 amb 0.2 0.2 0.2 emis 0 0 0 spec 0 0 0 shi 1 trans 0\n"
    "OBJECT world\nkids 1\nOBJECT poly\nname \"flag\"\nloc 0 2 0\nnumvert 3\n0 0 0\n1 0 0.25\n0 3 0\n"
    "numsurf 1\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids 0\n";

json built(const TempFolder& folder, const std::string& source, const std::string& hpm) {
    const auto outcome = run_program(folder, "mesh build " + source + " --out " + hpm + " --threads 2");
    EXPECT_EQ(outcome.status, 0) << source << ": " << outcome.err;
    return outcome.status == 0 ? json::parse(outcome.out) : json();
}

json extracted(const TempFolder& folder, const std::string& hpm, const std::string& how,
               const std::string& ply) {
    const auto outcome = run_program(folder, "mesh extract " + hpm + " " + how + " --out " + ply);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? json::parse(outcome.out) : json();
}

TEST(MeshCommand, FullMeshComesBackInTheFilesOwnCoordinates) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const TempFolder folder;
    const std::string hpm = folder.file("m.hpm"), ply = folder.file("m.ply");
    EXPECT_EQ(built(folder, folder.write("dome.obj", dome()), hpm)["triangles"], 128);
    const json said = extracted(folder, hpm, "--tolerance 0", ply);
    EXPECT_EQ(said["triangles"], 128);
    EXPECT_EQ(said["vertices"], 81);
    EXPECT_EQ(said["error_m"], 0.0);
    const TriangleMesh mesh = sim_test::read_ply(ply);
    for (const glm::dvec3& p : mesh.vertices) {
        EXPECT_EQ(p.x, std::round(p.x));
        EXPECT_NEAR(p.z, 5.0 - 0.1 * (std::pow(p.x - 14, 2) + std::pow(p.y + 36, 2)), 1e-6);
    }

    built(folder, folder.write("flag.ac", kAc3d), hpm);
    extracted(folder, hpm, "--triangles 1", ply);
    std::set<std::array<double, 3>> places;
    for (const glm::dvec3& p : sim_test::read_ply(ply).vertices)
        places.insert({p.x, p.y, p.z});
    EXPECT_EQ(places, (std::set<std::array<double, 3>>{{0, 2, 0}, {1, 2, 0.25}, {0, 5, 0}}));
}

TEST(MeshCommand, SizesAndTolerancesAreKept) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const TempFolder folder;
    const std::string hpm = folder.file("m.hpm"), ply = folder.file("m.ply");
    built(folder, folder.write("dome.obj", dome()), hpm);
    double last_m = -1.0;
    for (int triangles : {100, 64, 30, 10}) {
        const json said = extracted(folder, hpm, "--triangles " + std::to_string(triangles), ply);
        EXPECT_LE(said["triangles"], triangles);
        EXPECT_GE(said["triangles"], triangles - 1);
        EXPECT_EQ(said["flipped"], 0);
        EXPECT_GE(said["error_m"].get<double>(), last_m);
        last_m = said["error_m"];
        EXPECT_EQ(sim_test::read_ply(ply).faces.size(), said["triangles"].get<size_t>());
    }
    for (double tolerance_m : {0.02, 0.1, 0.5}) {
        const json said = extracted(folder, hpm, "--tolerance " + std::to_string(tolerance_m), ply);
        EXPECT_LE(said["error_m"].get<double>(), tolerance_m);
        // Every vertex of the dome's surface is near a triangle; vertical distance is the larger one.
        const TriangleMesh mesh = sim_test::read_ply(ply);
        for (const glm::dvec3& p : mesh.vertices)
            EXPECT_NEAR(p.z, 5.0 - 0.1 * (std::pow(p.x - 14, 2) + std::pow(p.y + 36, 2)), 3.0 * tolerance_m);
    }
    const auto inspected = run_program(folder, "mesh inspect " + hpm);
    ASSERT_EQ(inspected.status, 0);
    const json said = json::parse(inspected.out);
    EXPECT_EQ(said["triangles"], 128);
    EXPECT_EQ(said["report"]["border_edges"], 32);
    EXPECT_EQ(said["parts"].size(), 1u);
}

TEST(MeshCommand, GeneratedMeterHasThePapersCount) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const TempFolder folder;
    const std::string glb = folder.file("meter.glb"), hpm = folder.file("m.hpm"), ply = folder.file("m.ply");
    ASSERT_EQ(run_program(folder, "mesh generate --out " + glb).status, 0);
    const json said = built(folder, glb, hpm);
    EXPECT_EQ(said["triangles"], 86802);
    EXPECT_EQ(said["duplicate_faces"], 0);
    EXPECT_EQ(said["collapsed_faces"], 0);
    const json small = extracted(folder, hpm, "--triangles 5381", ply);
    EXPECT_EQ(small["triangles"], 5381);
    EXPECT_EQ(small["flipped"], 0);
    EXPECT_LE(small["error_m"].get<double>(), 0.0005);
}

TEST(MeshCommand, BadInputIsOneLineAndLeavesNothing) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const TempFolder folder;
    const std::string hpm = folder.file("m.hpm"), out = folder.file("out");
    built(folder, folder.write("dome.obj", dome()), hpm);
    const std::string bytes = sim_test::read_all(hpm);
    const std::string cut = folder.write("cut.hpm", bytes.substr(0, bytes.size() / 2));
    std::string flipped = bytes;
    flipped[bytes.size() / 3] = static_cast<char>(flipped[bytes.size() / 3] ^ 4);
    const std::string nan = folder.write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    const std::string point = folder.write("point.obj", "v 0 0 0\nv 1 0 0\nv 1 0 0\nf 1 2 3\n");
    for (const std::string& words :
         {"mesh extract " + cut + " --triangles 5 --out " + out, "mesh inspect " + cut,
          "mesh inspect " + folder.write("flipped.hpm", flipped), "mesh inspect " + folder.file("absent.hpm"),
          "mesh inspect " + folder.write("dome.obj", dome()), "mesh build " + nan + " --out " + out,
          "mesh build " + point + " --out " + out}) {
        const auto outcome = run_program(folder, words);
        EXPECT_EQ(outcome.status, 1) << words;
        EXPECT_EQ(outcome.error_lines(), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(out)) << words;
    }
    for (const std::string& words :
         {std::string("mesh"), "mesh extract " + hpm + " --out " + out, "mesh build " + hpm,
          "mesh extract " + hpm + " --triangles 5 --tolerance 1 --out " + out,
          "mesh extract " + hpm + " --triangles 0 --out " + out})
        EXPECT_EQ(run_program(folder, words).status, 2) << words;
}

/// Real instruments: n-gons, open borders, duplicate faces, unwelded and non-manifold parts.
TEST(MeshCommand, InstrumentFilesBuildAndExtract) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const std::vector<std::string> paths = sim_test::instrument_files();
    if (paths.empty()) GTEST_SKIP() << "no " << sim_test::kInstrumentFolder;
    EXPECT_GE(paths.size(), 10u);
    const TempFolder folder;
    const std::string hpm = folder.file("m.hpm"), ply = folder.file("m.ply");
    for (const std::string& path : paths) {
        const json said = built(folder, path, hpm);
        ASSERT_FALSE(said.is_null()) << path;
        const auto full = said["triangles"].get<uint64_t>();
        const json half = extracted(folder, hpm, "--triangles " + std::to_string(full / 2 + 1), ply);
        EXPECT_LE(half["triangles"].get<uint64_t>(), full / 2 + 1 + full / 10) << path;
        EXPECT_EQ(half["flipped"], 0) << path;
    }
}

}  // namespace
