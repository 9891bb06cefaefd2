#include "data/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace data {

namespace {

// Which band plays which part; 0 for none.
struct BandRoles {
    std::array<int, 3> colour{1, 1, 1};
    int alpha = 0;
    GDALColorTableH palette = nullptr;
};

BandRoles roles_of(const RasterFile& file) {
    BandRoles roles;
    std::array<int, 3> named{};
    int colours = 0;
    for (int number = 1; number <= file.band_count(); ++number) {
        const GDALColorInterp meaning = GDALGetRasterColorInterpretation(file.band(number));
        if (meaning == GCI_AlphaBand) {
            roles.alpha = number;
            continue;
        }
        ++colours;
        if (meaning == GCI_RedBand) named[0] = number;
        if (meaning == GCI_GreenBand) named[1] = number;
        if (meaning == GCI_BlueBand) named[2] = number;
    }
    if (named[0] && named[1] && named[2]) {
        roles.colour = named;
    } else if (colours >= 3) {
        roles.colour = {1, 2, 3};
    } else {
        roles.palette = GDALGetRasterColorTable(file.band(1));
    }
    return roles;
}

// One band of a window, resampled to `size`.
struct Plane {
    const RasterFile& file;
    PixelWindow window;
    glm::ivec2 size;
    GDALRIOResampleAlg resampling;

    CPLErr read(GDALRasterBandH band, GDALDataType type, void* out) const {
        GDALRasterIOExtraArg extra;
        INIT_RASTERIO_EXTRA_ARG(extra);
        extra.eResampleAlg = resampling;
        return GDALRasterIOEx(band, GF_Read, window.begin.x, window.begin.y, window.size.x, window.size.y,
                              out, size.x, size.y, type, 0, 0, &extra);
    }
};

bool read_bytes(const Plane& plane, GDALRasterBandH band, std::vector<uint8_t>& out) {
    out.resize(static_cast<size_t>(plane.size.x) * static_cast<size_t>(plane.size.y));
    if (GDALGetRasterDataType(band) == GDT_Byte) return plane.read(band, GDT_Byte, out.data()) == CE_None;
    std::array<double, 2> range{};
    if (GDALComputeRasterMinMax(band, TRUE, range.data()) != CE_None) return false;
    std::vector<float> values(out.size());
    if (plane.read(band, GDT_Float32, values.data()) != CE_None) return false;
    const double per_unit = range[1] > range[0] ? 255.0 / (range[1] - range[0]) : 0.0;
    std::transform(values.begin(), values.end(), out.begin(), [&](float value) {
        const double stretched = (double{value} - range[0]) * per_unit;
        return static_cast<uint8_t>(stretched > 0.0 ? std::lround(std::min(stretched, 255.0)) : 0);
    });
    return true;
}

void look_up(GDALColorTableH palette, Image& image) {
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        GDALColorEntry entry{};
        const bool is_known = GDALGetColorEntryAsRGB(palette, image.rgba[i], &entry) != 0;
        const std::array<short, 4> channels{entry.c1, entry.c2, entry.c3, entry.c4};
        for (size_t c = 0; c < 4; ++c) {
            const uint8_t value = static_cast<uint8_t>(std::clamp<int>(is_known ? channels[c] : 0, 0, 255));
            image.rgba[i + c] = c < 3 ? value : std::min(image.rgba[i + c], value);
        }
    }
}

bool read_alpha(const Plane& plane, const BandRoles& roles, Image& image) {
    std::vector<uint8_t> mask;
    const auto widen = [&] {
        for (size_t i = 0; i < mask.size(); ++i)
            image.rgba[4 * i + 3] = std::max(image.rgba[4 * i + 3], mask[i]);
    };
    if (roles.alpha) {
        if (!read_bytes(plane, plane.file.band(roles.alpha), mask)) return false;
        widen();
        return true;
    }
    for (int number : roles.colour) {
        if (!read_bytes(plane, GDALGetMaskBand(plane.file.band(number)), mask)) return false;
        widen();
    }
    return true;
}

}  // namespace

lod::Result<Image> read_picture(const RasterFile& file, const PixelWindow& window, const glm::ivec2& size) {
    const GdalMessages messages;
    const BandRoles roles = roles_of(file);
    const Plane plane{file, window, size, roles.palette ? GRIORA_NearestNeighbour : GRIORA_Average};
    Image image{size.x, size.y, {}};
    image.rgba.assign(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * 4, 0);
    std::vector<uint8_t> values;
    bool is_read = true;
    for (size_t c = 0; c < 3 && is_read; ++c) {
        is_read = read_bytes(plane, file.band(roles.colour[c]), values);
        for (size_t i = 0; i < values.size(); ++i)
            image.rgba[4 * i + c] = values[i];
    }
    is_read = is_read && read_alpha(plane, roles, image);
    if (!is_read || messages.has_failed()) {
        return lod::Error{"imagery '" + file.path + "': " + messages.text("unreadable") + "; expected " +
                          std::to_string(file.width) + " x " + std::to_string(file.height) + " pixels"};
    }
    if (roles.palette) look_up(roles.palette, image);
    return image;
}

}  // namespace data
