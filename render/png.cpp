#include <png.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "render/renderer.h"

namespace render {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

std::vector<uint8_t> without_alpha(const ColourImage& image) {
    std::vector<uint8_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    for (size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
        rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
    }
    return rgb;
}

/// Complete on success; whatever is there on failure.
lod::Result<lod::Ok> write_file(const std::string& path, const ColourImage& image) {
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "wb"));
    if (!file) return lod::Error{"cannot create " + path + ", expected a writable folder"};
    const std::vector<uint8_t> rgb = without_alpha(image);
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    const bool is_written = png_image_write_to_stdio(&header, file.get(), 0, rgb.data(), 0, nullptr) != 0;
    if (!is_written || std::fflush(file.get()) != 0) {
        return lod::Error{"cannot write " + path + " (" + header.message + "), expected room on the disk"};
    }
    return lod::Ok{};
}

}  // namespace

lod::Result<lod::Ok> write_png(const std::string& path, const ColourImage& image) {
    CHECK(image.width > 0 && image.height > 0);
    CHECK(image.rgba.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4);
    const std::string unfinished = path + ".part";
    std::error_code failure;
    if (auto written = write_file(unfinished, image); !written) {
        std::filesystem::remove(unfinished, failure);
        return written;
    }
    std::filesystem::rename(unfinished, path, failure);
    if (!failure) return lod::Ok{};
    const std::string reason = failure.message();
    std::filesystem::remove(unfinished, failure);
    return lod::Error{"cannot write " + path + " (" + reason + "), expected a writable file name"};
}

}  // namespace render
