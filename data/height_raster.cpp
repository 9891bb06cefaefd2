#include "data/height_raster.h"

#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "data/height_unit.h"
#include "data/raster_file.h"

namespace data {

namespace {

constexpr double kHighest_m = 12000.0;
constexpr int64_t kMaxSamples = std::numeric_limits<int32_t>::max();
constexpr int64_t kStripSamples = 1 << 20;

// How a band's raw numbers become metres or voids.
struct BandRules {
    bool has_nodata = false;
    double nodata = 0.0;
    double nodata_slack = 0.0;  // files state -1e37 and store the float next to it
    double scale = 1.0, offset = 0.0, metres_per_unit = 1.0;
    bool has_undeclared_nodata = true;

    bool is_void(double raw) const {
        if (!std::isfinite(raw)) return true;
        if (has_nodata && std::abs(raw - nodata) <= nodata_slack) return true;
        if (!has_undeclared_nodata) return false;
        const bool is_packed =
            offset != 0.0;  // then raw numbers are no heights, and only the type's end is a code
        const bool is_code = raw == -32768.0 || (!is_packed && (raw == -32767.0 || raw == -9999.0));
        return is_code || std::abs(metres(raw)) > kHighest_m;
    }
    double metres(double raw) const { return (raw * scale + offset) * metres_per_unit; }
};

lod::Result<BandRules> rules_of(const RasterFile& file, bool has_undeclared_nodata) {
    const GDALRasterBandH band = file.band(1);
    const std::string where = "terrain '" + file.path + "': ";
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band))) {
        return lod::Error{where + "band 1 holds complex numbers; expected heights"};
    }
    if (file.band_count() >= 3 && GDALGetRasterColorInterpretation(band) == GCI_RedBand) {
        return lod::Error{where + "is a picture (red, green, blue); expected one band of heights"};
    }
    BandRules rules;
    rules.has_undeclared_nodata = has_undeclared_nodata;
    int has_value = 0;
    rules.nodata = GDALGetRasterNoDataValue(band, &has_value);
    rules.has_nodata = has_value != 0;
    rules.nodata_slack = 1e-6 * std::abs(rules.nodata);
    const double scale = GDALGetRasterScale(band, &has_value);
    if (has_value && scale != 0.0) rules.scale = scale;
    const double offset = GDALGetRasterOffset(band, &has_value);
    if (has_value) rules.offset = offset;

    const std::string unit = GDALGetRasterUnitType(band);
    rules.metres_per_unit = unit.empty() ? metres_per_vertical_unit(file.crs_wkt) : metres_per_unit(unit);
    if (rules.metres_per_unit <= 0.0) {
        return lod::Error{where + "heights are in '" + unit + "'; expected metres or feet"};
    }
    return rules;
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

// Appends rows [row, row + rows) to the raster.
lod::Result<lod::Ok> read_rows(const RasterFile& file, const BandRules& rules, int row, int rows,
                               std::vector<double>& scratch, HeightRaster& out) {
    const GdalMessages messages;
    scratch.resize(static_cast<size_t>(file.width) * static_cast<size_t>(rows));
    const CPLErr outcome = GDALRasterIO(file.band(1), GF_Read, 0, row, file.width, rows, scratch.data(),
                                        file.width, rows, GDT_Float64, 0, 0);
    if (outcome != CE_None || messages.has_failed()) {
        return lod::Error{"terrain '" + file.path + "': rows " + std::to_string(row) + " to " +
                          std::to_string(row + rows - 1) + ": " + messages.text("unreadable") +
                          "; expected " + size_text(file.width, file.height) + " samples"};
    }
    for (double raw : scratch) {
        const bool is_void = rules.is_void(raw);
        out.height_m.push_back(is_void ? 0.0f : static_cast<float>(rules.metres(raw)));
        out.is_void.push_back(is_void);
    }
    return lod::Ok{};
}

lod::Result<HeightRaster> read_all(const RasterFile& file, const BandRules& rules) {
    HeightRaster raster;
    raster.path = file.path;
    raster.width = file.width;
    raster.height = file.height;
    raster.geo_transform = file.geo_transform;
    raster.crs_wkt = file.crs_wkt;
    const size_t samples = static_cast<size_t>(file.width) * static_cast<size_t>(file.height);
    raster.height_m.reserve(samples);  // touched only as far as the file delivers
    raster.is_void.reserve(samples);
    int block_cols = 0, block_rows = 1;
    GDALGetBlockSize(file.band(1), &block_cols, &block_rows);
    const int64_t wanted = std::max<int64_t>(kStripSamples / file.width / block_rows, 1) * block_rows;
    const int strip = static_cast<int>(std::min<int64_t>(wanted, file.height));
    std::vector<double> scratch;
    for (int row = 0; row < file.height; row += strip) {
        const int rows = std::min(strip, file.height - row);
        if (auto done = read_rows(file, rules, row, rows, scratch, raster); !done) return done.error();
    }
    return raster;
}

template <typename T>
std::vector<T> transposed(const std::vector<T>& in, int width, int height) {
    std::vector<T> out(in.size());
    const size_t w = static_cast<size_t>(width), h = static_cast<size_t>(height);
    for (size_t row = 0; row < h; ++row) {
        for (size_t col = 0; col < w; ++col)
            out[col * h + row] = in[row * w + col];
    }
    return out;
}

template <typename T>
void reverse_columns(std::vector<T>& values, int width) {
    for (auto row = values.begin(); row != values.end(); row += width)
        std::reverse(row, row + width);
}

template <typename T>
void reverse_rows(std::vector<T>& values, int width, int height) {
    for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom) {
        const auto first = values.begin() + std::ptrdiff_t{top} * width;
        std::swap_ranges(first, first + width, values.begin() + std::ptrdiff_t{bottom} * width);
    }
}

void transpose(HeightRaster& raster) {
    raster.height_m = transposed(raster.height_m, raster.width, raster.height);
    raster.is_void = transposed(raster.is_void, raster.width, raster.height);
    auto& g = raster.geo_transform;
    g = {g[0], g[2], g[1], g[3], g[5], g[4]};
    std::swap(raster.width, raster.height);
}

void mirror_columns(HeightRaster& raster) {
    reverse_columns(raster.height_m, raster.width);
    reverse_columns(raster.is_void, raster.width);
    auto& g = raster.geo_transform;
    g = {g[0] + g[1] * raster.width, -g[1], g[2], g[3] + g[4] * raster.width, -g[4], g[5]};
}

void mirror_rows(HeightRaster& raster) {
    reverse_rows(raster.height_m, raster.width, raster.height);
    reverse_rows(raster.is_void, raster.width, raster.height);
    auto& g = raster.geo_transform;
    g = {g[0] + g[2] * raster.height, g[1], -g[2], g[3] + g[5] * raster.height, g[4], -g[5]};
}

}  // namespace

bool orient(HeightRaster& raster, const glm::dmat2& compass_from_cells) {
    glm::dvec2 along_row = compass_from_cells[0], along_col = compass_from_cells[1];
    const bool is_turned =
        std::abs(along_row.x) + std::abs(along_col.y) < std::abs(along_row.y) + std::abs(along_col.x);
    if (is_turned) {
        transpose(raster);
        std::swap(along_row, along_col);
    }
    if (along_row.x < 0.0) mirror_columns(raster);
    if (along_col.y > 0.0) mirror_rows(raster);
    return is_turned || along_row.x < 0.0 || along_col.y > 0.0;
}

lod::Result<HeightRaster> read_height_raster(const std::string& path, bool has_undeclared_nodata) {
    const auto file = open_raster(path, "terrain");
    if (!file) return file.error();
    const auto rules = rules_of(*file, has_undeclared_nodata);
    if (!rules) return rules.error();
    if (int64_t{file->width} * file->height > kMaxSamples) {
        return lod::Error{"terrain '" + path + "': " + size_text(file->width, file->height) +
                          " samples; expected at most 2^31"};
    }
    try {
        auto raster = read_all(*file, *rules);
        if (raster) {
            const auto& g = raster->geo_transform;
            orient(*raster, glm::dmat2(g[1], g[4], g[2], g[5]));
        }
        return raster;
    } catch (const std::bad_alloc&) {
        return lod::Error{"terrain '" + path + "': " + size_text(file->width, file->height) +
                          " samples do not fit into memory"};
    }
}

}  // namespace data
