// Files that the program leaves behind, read back by other means.
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "sim/depth_tiff.h"
#include "sim/ply_writer.h"
#include "sim/whole_file.h"
#include "tests/sim/temp_folder.h"

namespace {

using sim_test::read_all;
using sim_test::TempFolder;

/// Two triangles that share an edge in module 0, and one on top of them in module 1.
render::DrawnTriangles some_triangles() {
    const glm::dvec3 a(4.5e6, 5.1e5, 0.1), b(4.5e6 + 1e-9, 0, 0), c(0, 1.0 / 3.0, -0.0), d(1, 1, 1);
    render::DrawnTriangles drawn;
    drawn.world = {{a, b, c}, {c, b, d}, {a, b, c}};
    drawn.module = {lod::Module::kTerrain, lod::Module::kTerrain, lod::Module::kObjects};
    return drawn;
}

template <typename Value>
Value take(const std::string& bytes, size_t& at) {
    Value value;
    std::memcpy(&value, bytes.data() + at, sizeof(Value));
    at += sizeof(Value);
    return value;
}

TEST(PlyWriter, HoldsEveryTriangleBitForBit) {
    const TempFolder folder;
    const render::DrawnTriangles drawn = some_triangles();
    ASSERT_TRUE(sim::write_ply(folder.file("a.ply"), sim::merge_corners(drawn)));
    const std::string bytes = read_all(folder.file("a.ply"));
    EXPECT_NE(bytes.find("element vertex 7\n"), std::string::npos);  // 4 of the terrain, 3 of the objects
    EXPECT_NE(bytes.find("element face 3\n"), std::string::npos);
    EXPECT_NE(bytes.find("property double x\n"), std::string::npos);
    EXPECT_NE(bytes.find("property list uchar int vertex_indices\nproperty uchar module\n"),
              std::string::npos);
    size_t at = bytes.find("end_header\n") + 11;
    std::vector<glm::dvec3> vertices;
    for (int i = 0; i < 7; ++i) {
        const auto x = take<double>(bytes, at), y = take<double>(bytes, at), z = take<double>(bytes, at);
        vertices.emplace_back(x, y, z);
    }
    for (size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(take<uint8_t>(bytes, at), 3);
        for (int corner = 0; corner < 3; ++corner) {
            const auto index = take<int32_t>(bytes, at);
            EXPECT_EQ(vertices.at(static_cast<size_t>(index)), drawn.world[i][static_cast<size_t>(corner)]);
        }
        EXPECT_EQ(take<uint8_t>(bytes, at), static_cast<uint8_t>(drawn.module[i]));
    }
    EXPECT_EQ(at, bytes.size());
}

TEST(PlyWriter, NothingDrawnIsAnEmptyMesh) {
    const TempFolder folder;
    ASSERT_TRUE(sim::write_ply(folder.file("a.ply"), {}));
    EXPECT_NE(read_all(folder.file("a.ply")).find("element face 0\n"), std::string::npos);
}

TEST(DepthTiff, ReadsBackThroughGdal) {
    const TempFolder folder;
    const render::DepthImage depth{3, 2, {1.5f, 2.5f, INFINITY, 1e-3f, 4e7f, 7.0f}};
    ASSERT_TRUE(sim::write_depth_tiff(folder.file("d.tif"), depth));
    GDALAllRegister();
    auto* file = GDALDataset::Open(folder.file("d.tif").c_str());
    ASSERT_NE(file, nullptr);
    EXPECT_EQ(file->GetRasterXSize(), 3);
    EXPECT_EQ(file->GetRasterYSize(), 2);
    EXPECT_EQ(file->GetRasterBand(1)->GetRasterDataType(), GDT_Float32);
    EXPECT_EQ(file->GetSpatialRef(), nullptr);
    std::vector<float> pixels(6);
    ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 3, 2, pixels.data(), 3, 2, GDT_Float32, 0, 0,
                                               nullptr),
              CE_None);
    EXPECT_EQ(pixels, depth.depth_m);
    GDALClose(file);
}

TEST(WholeFile, FailureLeavesNothingBehind) {
    const TempFolder folder;
    const std::string path = folder.file("a.bin");
    const auto failed = sim::write_whole(path, [](const std::string& part) {
        std::ofstream(part) << "half";
        return false;
    });
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.message().find(path), 0u);
    EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
    EXPECT_FALSE(sim::write_whole(folder.file("no/such/folder.txt"), "x"));
    EXPECT_FALSE(sim::write_depth_tiff(folder.file("no/such/folder.tif"), {1, 1, {1.0f}}));
    EXPECT_FALSE(sim::write_ply(folder.file("no/such/folder.ply"), {}));
}

TEST(WholeFile, ReplacesWhatWasThere) {
    const TempFolder folder;
    const std::string path = folder.write("a.txt", "old and long");
    EXPECT_TRUE(sim::check_writable(path));
    EXPECT_EQ(read_all(path), "old and long");
    ASSERT_TRUE(sim::write_whole(path, "new"));
    EXPECT_EQ(read_all(path), "new");
    EXPECT_FALSE(sim::check_writable(folder.file("no/such/folder")));
    EXPECT_FALSE(sim::check_writable(folder.file("")));
}

}  // namespace
