#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>

#include "lod/base/rng.h"
#include "render/renderer.h"

namespace {

namespace fs = std::filesystem;

class Png : public testing::Test {
  protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(HARRIER_BINARY_DIR) / ("png_test_" + std::string(info->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

render::ColourImage random_image(int width, int height) {
    lod::Rng rng(9);
    render::ColourImage image{width, height, {}};
    for (int i = 0; i < width * height * 4; ++i)
        image.rgba.push_back(static_cast<uint8_t>(rng.below(256)));
    return image;
}

TEST_F(Png, ReadsBackAsItWasWritten) {
    const auto image = random_image(37, 11);
    const std::string path = folder_ / "picture.png";
    ASSERT_TRUE(render::write_png(path, image));

    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&header, path.c_str()));
    EXPECT_EQ(header.format, unsigned(PNG_FORMAT_RGB)) << "8-bit RGB";
    header.format = PNG_FORMAT_RGBA;
    ASSERT_EQ(header.width, 37u);
    ASSERT_EQ(header.height, 11u);
    std::vector<uint8_t> back(37 * 11 * 4);
    ASSERT_TRUE(png_image_finish_read(&header, nullptr, back.data(), 0, nullptr));
    for (size_t i = 0; i < back.size(); ++i)
        EXPECT_EQ(back[i], i % 4 == 3 ? 255 : image.rgba[i]) << i;
}

TEST_F(Png, LeavesNothingBesideTheFile) {
    const std::string path = folder_ / "picture.png";
    ASSERT_TRUE(render::write_png(path, random_image(4, 4)));
    ASSERT_TRUE(render::write_png(path, random_image(5, 5))) << "replaces";
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Png, SaysWhereItCannotWrite) {
    const std::string missing = folder_ / "no_such_folder" / "picture.png";
    const auto failed = render::write_png(missing, random_image(4, 4));
    ASSERT_FALSE(failed);
    EXPECT_NE(failed.message().find(missing), std::string::npos);

    fs::create_directories(folder_ / "folder.png" / "inside");
    EXPECT_FALSE(render::write_png(folder_ / "folder.png", random_image(4, 4)));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1)
        << "nothing half-written";
}

TEST_F(Png, AFullDiskIsAnErrorNotAPicture) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    fs::create_symlink("/dev/full", folder_ / "picture.png.part");
    EXPECT_FALSE(render::write_png(folder_ / "picture.png", random_image(64, 64)));
    EXPECT_FALSE(fs::exists(folder_ / "picture.png"));
}

}  // namespace
