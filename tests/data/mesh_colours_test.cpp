#include "data/polygon_mesh.h"

#include <gdal.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/data/small_models.h"

namespace {

using data::MeshNode;
using data::PolygonMeshStats;
using namespace test;

// What a file beside it calls a file.
std::string name_of(const std::string& name) {
    return std::filesystem::path(file_path(name)).filename().string();
}

// An RGBA picture from its rows, top first.
std::string write_png(const std::string& name, int width, int height, std::vector<uint8_t> rgba) {
    GDALAllRegister();
    GDALDatasetH memory = GDALCreate(GDALGetDriverByName("MEM"), "", width, height, 4, GDT_Byte, nullptr);
    EXPECT_EQ(GDALDatasetRasterIO(memory, GF_Write, 0, 0, width, height, rgba.data(), width, height, GDT_Byte,
                                  4, nullptr, 4, 4 * width, 1),
              CE_None);
    GDALDriverH png = GDALGetDriverByName("PNG");
    GDALClose(GDALCreateCopy(png, file_path(name).c_str(), memory, FALSE, nullptr, nullptr, nullptr));
    GDALClose(memory);
    return file_path(name);
}

// A square with the whole of a texture on it.
std::string textured_obj(const std::string& mtl) {
    return "mtllib " + mtl +
           "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl paint\nf 1/1 2/2 "
           "3/3 4/4\n";
}

TEST(MeshColours, TexturesBecomeVertexColours) {
    // Quarters: red and green above, blue and white below.
    std::vector<uint8_t> rgba;
    for (int row = 0; row < 64; ++row) {
        for (int col = 0; col < 64; ++col) {
            const bool is_left = col < 32, is_above = row < 32;
            const glm::u8vec4 texel =
                is_above ? (is_left ? glm::u8vec4(255, 0, 0, 255) : glm::u8vec4(0, 255, 0, 255))
                         : (is_left ? glm::u8vec4(0, 0, 255, 255) : glm::u8vec4(255));
            rgba.insert(rgba.end(), {texel.x, texel.y, texel.z, texel.w});
        }
    }
    write_png("quarters.png", 64, 64, rgba);
    write_file("quarters.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd " + name_of("quarters.png") + "\n");
    PolygonMeshStats stats;
    const auto mesh =
        data::read_polygon_mesh(write_file("quarters.obj", textured_obj(name_of("quarters.mtl"))), &stats);
    ASSERT_TRUE(mesh) << mesh.message();
    check_promises(*mesh);
    EXPECT_TRUE(stats.missing_files.empty());
    ASSERT_EQ(mesh->textures.size(), 1u);
    EXPECT_EQ(mesh->textures[0].width, 64);
    EXPECT_EQ(mesh->textures[0].rgba[2], 255);  // row 0 is the lower one, blue
    EXPECT_EQ(mesh->textures[0].rgba[0], 0);
    for (const MeshNode& node : mesh->nodes) {
        for (size_t i = 0; i < node.positions.size(); ++i) {
            const bool is_left = node.positions[i].x<0.5f, is_above = node.positions[i].y> 0.5f;
            const glm::ivec4 colour(node.colours[i]);
            const int strongest = std::max({colour.x, colour.y, colour.z});
            if (is_above) {
                EXPECT_EQ(is_left ? colour.x : colour.y, strongest) << i;
            }
            if (!is_above && is_left) {
                EXPECT_EQ(colour.z, strongest) << i;
            }
            if (!is_above && !is_left) {
                EXPECT_GT(std::min({colour.x, colour.y, colour.z}), 150) << i;
            }
        }
    }
}

// A chessboard of single texels has no colour a single sample would find: its mean in linear light is sRGB 188.
TEST(MeshColours, TexturesAreAveragedInLinearLight) {
    std::vector<uint8_t> rgba;
    for (int i = 0; i < 64 * 64; ++i) {
        const uint8_t grey = (i + i / 64) % 2 == 0 ? 255 : 0;
        rgba.insert(rgba.end(), {grey, grey, grey, 255});
    }
    write_png("chess.png", 64, 64, rgba);
    write_file("chess.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd " + name_of("chess.png") + "\n");
    const auto mesh = data::read_polygon_mesh(write_file("chess.obj", textured_obj(name_of("chess.mtl"))));
    ASSERT_TRUE(mesh) << mesh.message();
    for (const MeshNode& node : mesh->nodes) {
        for (const glm::u8vec4& colour : node.colours)
            EXPECT_NEAR(colour.x, 188, 1);
    }
}

TEST(MeshColours, MissingTexturesLeaveTheMaterialsColour) {
    write_file("missing.mtl", "newmtl paint\nKd 0.2 0.4 0.6\nd 0.5\nmap_Kd nowhere.png\n");
    PolygonMeshStats stats;
    const auto mesh =
        data::read_polygon_mesh(write_file("missing.obj", textured_obj(name_of("missing.mtl"))), &stats);
    ASSERT_TRUE(mesh) << mesh.message();
    EXPECT_EQ(stats.missing_files, std::vector<std::string>{"nowhere.png"});
    for (const MeshNode& node : mesh->nodes) {
        for (const glm::u8vec4& colour : node.colours)
            EXPECT_EQ(colour, glm::u8vec4(51, 102, 153, 128));
    }
}

TEST(MeshColours, MissingMaterialFilesAreNamed) {
    PolygonMeshStats stats;
    ASSERT_TRUE(
        data::read_polygon_mesh(write_file("bare.obj", textured_obj("no materials here.mtl")), &stats));
    EXPECT_EQ(stats.missing_files, std::vector<std::string>{"no materials here.mtl"});
    write_file("own name.mtl", "newmtl paint\nKd 0.2 0.4 0.6\n");
    ASSERT_TRUE(data::read_polygon_mesh(write_file("own name.obj", textured_obj("elsewhere.mtl")), &stats));
    EXPECT_TRUE(stats.missing_files.empty()) << "the model's own name serves too";
}

TEST(MeshColours, PlyVertexColoursAreTaken) {
    const auto mesh = data::read_polygon_mesh(write_file(
        "colours.ply", ply_text("ascii", "0 0 0 10 20 30\n1 0 0 10 20 30\n0 1 0 200 100 0\n3 0 1 2\n")));
    ASSERT_TRUE(mesh) << mesh.message();
    check_promises(*mesh);
    for (const MeshNode& node : mesh->nodes) {
        for (size_t i = 0; i < node.positions.size(); ++i)
            EXPECT_EQ(node.colours[i], node.positions[i].y > 0.5f ? glm::u8vec4(200, 100, 0, 255)
                                                                  : glm::u8vec4(10, 20, 30, 255));
    }
}

}  // namespace
