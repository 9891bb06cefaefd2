#include "data/texture_image.h"

#include <cpl_vsi.h>
#include <gdal.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "data/gdal_border.h"

namespace data {

namespace {

constexpr int kMaxSize_px = 8192;

/// One band's samples as bytes.
std::optional<std::vector<uint8_t>> read_band(GDALRasterBandH band, int width, int height) {
    const bool is_deep = GDALGetRasterDataType(band) != GDT_Byte;
    std::vector<uint16_t> samples(static_cast<size_t>(width) * static_cast<size_t>(height));
    if (GDALRasterIO(band, GF_Read, 0, 0, width, height, samples.data(), width, height, GDT_UInt16, 0, 0) !=
        CE_None)
        return std::nullopt;
    std::vector<uint8_t> bytes(samples.size());
    std::transform(samples.begin(), samples.end(), bytes.begin(), [is_deep](uint16_t sample) {
        return static_cast<uint8_t>(is_deep ? sample >> 8 : sample);
    });
    return bytes;
}

/// Writes a palette's colours for the indices of one band.
void apply_palette(GDALColorTableH palette, const std::vector<uint8_t>& indices, std::vector<uint8_t>& rgba) {
    for (size_t i = 0; i < indices.size(); ++i) {
        GDALColorEntry entry{0, 0, 0, 255};
        GDALGetColorEntryAsRGB(palette, indices[i], &entry);
        const short parts[4] = {entry.c1, entry.c2, entry.c3, entry.c4};
        for (size_t part = 0; part < 4; ++part)
            rgba[4 * i + part] = static_cast<uint8_t>(std::clamp<int>(parts[part], 0, 255));
    }
}

/// Top row last: v runs upwards.
void flip_rows(MeshTexture& texture) {
    const auto row_bytes = static_cast<std::ptrdiff_t>(texture.width) * 4;
    for (int low = 0, high = texture.height - 1; low < high; ++low, --high) {
        const auto a = texture.rgba.begin() + low * row_bytes, b = texture.rgba.begin() + high * row_bytes;
        std::swap_ranges(a, a + row_bytes, b);
    }
}

std::optional<MeshTexture> pixels_of(GDALDatasetH image) {
    MeshTexture texture;
    texture.width = GDALGetRasterXSize(image);
    texture.height = GDALGetRasterYSize(image);
    const int bands = std::min(GDALGetRasterCount(image), 4);
    if (bands < 1 || std::max(texture.width, texture.height) > kMaxSize_px) return std::nullopt;
    texture.rgba.assign(static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height) * 4, 255);
    for (int band = 0; band < bands; ++band) {
        GDALRasterBandH source = GDALGetRasterBand(image, band + 1);
        const std::optional<std::vector<uint8_t>> bytes = read_band(source, texture.width, texture.height);
        if (!bytes) return std::nullopt;
        GDALColorTableH palette = GDALGetRasterColorTable(source);
        if (bands == 1 && palette != nullptr) {
            apply_palette(palette, *bytes, texture.rgba);
            continue;
        }
        // One band is grey, two are grey and opacity, three or four are colours and opacity.
        const bool is_opacity = bands % 2 == 0 && band == bands - 1;
        const size_t first = is_opacity ? 3 : static_cast<size_t>(band),
                     last = bands < 3 && !is_opacity ? 2 : first;
        for (size_t i = 0; i < bytes->size(); ++i) {
            for (size_t part = first; part <= last; ++part)
                texture.rgba[4 * i + part] = (*bytes)[i];
        }
    }
    flip_rows(texture);
    return texture;
}

std::optional<MeshTexture> open_image(const std::string& path) {
    static constexpr const char* kDrivers[] = {"PNG", "JPEG", "GIF", "BMP", "GTiff", "WEBP", "SGI", nullptr};
    const GdalMessages messages;
    const DatasetPtr image(
        GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers, nullptr, nullptr));
    if (!image) return std::nullopt;
    std::optional<MeshTexture> texture = pixels_of(image.get());
    if (messages.has_failed()) return std::nullopt;
    return texture;
}

/// A file in GDAL's memory over somebody else's bytes, gone with the scope.
class MemoryFile {
  public:
    explicit MemoryFile(std::span<const uint8_t> bytes) : bytes_(bytes.begin(), bytes.end()) {
        path_ = "/vsimem/harrier_texture_" + std::to_string(reinterpret_cast<uintptr_t>(this));
        VSIFCloseL(VSIFileFromMemBuffer(path_.c_str(), bytes_.data(), bytes_.size(), FALSE));
    }
    ~MemoryFile() { VSIUnlink(path_.c_str()); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::vector<uint8_t> bytes_;
    std::string path_;
};

}  // namespace

std::optional<MeshTexture> read_texture(const std::string& path) {
    std::error_code failure;  // only plain files: a model must not make GDAL fetch from the network
    if (!std::filesystem::is_regular_file(path, failure)) return std::nullopt;
    return open_image(path);
}

std::optional<MeshTexture> decode_texture(std::span<const uint8_t> bytes) {
    if (bytes.empty()) return std::nullopt;
    const MemoryFile file(bytes);
    return open_image(file.path());
}

}  // namespace data
