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

// A grid of n by n quads as OBJ, and everything else from it.
std::string grid_obj(int n) {
    std::ostringstream text;
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k)
            text << "v " << i << " " << k << " " << (i * k) % 3 << "\n";
    }
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            const int a = i * (n + 1) + k + 1;
            text << "f " << a << " " << a + n + 1 << " " << a + n + 2 << " " << a + 1 << "\n";
        }
    }
    return text.str();
}

std::string grid_ply(int n) {
    std::string obj = grid_obj(n);
    std::istringstream lines(obj);
    std::ostringstream vertices, faces;
    std::string kind, a, b, c, d;
    while (lines >> kind >> a >> b >> c) {
        if (kind == "v") {
            vertices << a << " " << b << " " << c << "\n";
        } else {
            lines >> d;
            faces << "4 " << std::stoi(a) - 1 << " " << std::stoi(b) - 1 << " " << std::stoi(c) - 1 << " "
                  << std::stoi(d) - 1 << "\n";
        }
    }
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << (n + 1) * (n + 1)
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << n * n
         << "\nproperty list uchar int vertex_index\nend_header\n";
    return text.str() + vertices.str() + faces.str();
}

TEST(BrokenModels, TruncatedFilesAreRefusedOrValid) {
    struct Case {
        std::string extension, content;
        bool is_refused;  // the format tells its length
    };
    std::string sphere_text = "solid s\n";
    const std::vector<glm::vec3> corners = sphere_corners(6, 12);
    for (size_t i = 0; i < corners.size(); ++i) {
        if (i % 3 == 0) sphere_text += "facet normal 0 0 0\nouter loop\n";
        sphere_text += "vertex " + std::to_string(corners[i].x) + " " + std::to_string(corners[i].y) + " " +
                       std::to_string(corners[i].z) + "\n";
        if (i % 3 == 2) sphere_text += "endloop\nendfacet\n";
    }
    const Case cases[] = {
        {"glb", glb(), true},
        {"ac", kAc3d, false},
        {"obj", grid_obj(12), false},
        {"ply", grid_ply(12), false},  // a last line cut in its middle may still be a face
        {"stl", binary_stl(sphere_corners(6, 12)), true},
        {"stl", sphere_text + "endsolid s\n", true},
    };
    for (const Case& item : cases) {
        const auto whole = data::read_polygon_mesh(write_file("whole." + item.extension, item.content));
        ASSERT_TRUE(whole) << whole.message();
        check_promises(*whole);
        const size_t step = std::max<size_t>(item.content.size() / 64, 7);
        for (size_t length = 0; length + 10 < item.content.size(); length += step) {
            SCOPED_TRACE(item.extension + " " + std::to_string(length));
            const auto mesh =
                data::read_polygon_mesh(write_file("cut." + item.extension, item.content.substr(0, length)));
            if (mesh) check_promises(*mesh);
            EXPECT_FALSE(mesh && item.is_refused);
        }
    }
}

TEST(BrokenModels, RealFilesTruncatedAtEveryKilobyte) {
    const fs::path crane = shared_data() / "city/tracked_crane.glb",
                   oat = shared_data() / "instruments/c172p/Panel_Instruments/oat/oat.ac";
    if (!fs::exists(crane) || !fs::exists(oat)) GTEST_SKIP() << "no " << crane << " or " << oat;
    for (const fs::path& path : {crane, oat}) {
        std::ifstream file(path, std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(file), {}};
        for (size_t length = 0; length < content.size(); length += 1024) {
            const std::string cut = write_file("real" + path.extension().string(), content.substr(0, length));
            EXPECT_FALSE(data::read_polygon_mesh(cut)) << path << " " << length;
        }
    }
}

}  // namespace
