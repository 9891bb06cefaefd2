#include "data/polygon_mesh.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/data/small_models.h"

namespace {

namespace fs = std::filesystem;
using namespace test;

std::string gzip(const std::string& content) {
    const std::string path = file_path("packing.gz");
    gzFile file = gzopen(path.c_str(), "wb");
    EXPECT_EQ(gzwrite(file, content.data(), static_cast<unsigned>(content.size())),
              static_cast<int>(content.size()));
    gzclose(file);
    std::ifstream back(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(back), {}};
}

TEST(BrokenModels, GzipIsUnpacked) {
    const std::string stl = binary_stl(sphere_corners(12, 24)), packed = gzip(stl);
    const auto plain = data::read_polygon_mesh(write_file("plain.stl", stl));
    const auto unpacked = data::read_polygon_mesh(write_file("packed.stl.gz", packed));
    ASSERT_TRUE(plain) << plain.message();
    ASSERT_TRUE(unpacked) << unpacked.message();
    EXPECT_EQ(unpacked->triangle_count(), plain->triangle_count());
    EXPECT_EQ(unpacked->nodes.back().positions, plain->nodes.back().positions);
    for (size_t length = 0; length < packed.size(); length += 97)
        EXPECT_FALSE(data::read_polygon_mesh(write_file("cut.stl.gz", packed.substr(0, length)))) << length;
    std::string damaged = packed;
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
    EXPECT_FALSE(data::read_polygon_mesh(write_file("damaged.stl.gz", damaged)));
}

TEST(BrokenModels, UnusableFilesAreRefusedInOneLine) {
    std::vector<glm::vec3> broken = cube_corners();
    broken[7].y = std::numeric_limits<float>::quiet_NaN();
    const std::string paths[] = {
        "/nonexistent.ac",
        testing::TempDir(),
        write_file("empty.ac", ""),
        write_file("noise.glb", "noise"),
        write_file("noise.xyz", "noise"),
        write_file("noise.stl.gz", "noise"),
        write_file("nan.stl", binary_stl(broken)),
        write_file("endless.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
        write_file("greedy.ply", ply_text("binary_little_endian", "short")),
        write_file("points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n"),
        write_file("flat.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n"),
    };
    for (const std::string& path : paths) {
        const auto mesh = data::read_polygon_mesh(path);
        ASSERT_FALSE(mesh) << path;
        EXPECT_NE(mesh.message().find(path), std::string::npos) << mesh.message();
        EXPECT_EQ(mesh.message().find('\n'), std::string::npos) << mesh.message();
    }
}

}  // namespace
