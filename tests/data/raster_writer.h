// Rasters for tests, written with GDAL into its memory file system.
#pragma once

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <array>
#include <string>
#include <vector>

namespace test {

/// What to write; defaults are a small DEM in WGS84 degrees with the origin at 7 E, 44 N.
struct RasterSpec {
    int width = 0, height = 0;
    std::vector<double> values{};  ///< band after band
    int bands = 1;
    GDALDataType type = GDT_Float32;
    std::array<double, 6> geo_transform = {7.0, 0.01, 0.0, 44.0, 0.0, -0.01};
    std::string crs = "EPSG:4326";  ///< empty: none
    bool has_nodata = false;
    double nodata = 0.0;
    double scale = 1.0, offset = 0.0;
    std::string unit{};
    std::vector<std::string> options{};  ///< creation options
    std::string driver = "GTiff";
};

/// @returns the path, /vsimem/NAME
inline std::string write_raster(const std::string& name, const RasterSpec& spec) {
    GDALAllRegister();
    const std::string path = "/vsimem/" + name;
    char** options = nullptr;
    for (const std::string& option : spec.options)
        options = CSLAddString(options, option.c_str());
    GDALDatasetH dataset = GDALCreate(GDALGetDriverByName(spec.driver.c_str()), path.c_str(), spec.width,
                                      spec.height, spec.bands, spec.type, options);
    CSLDestroy(options);
    EXPECT_NE(dataset, nullptr);
    std::array<double, 6> geo_transform = spec.geo_transform;
    GDALSetGeoTransform(dataset, geo_transform.data());
    if (!spec.crs.empty()) {
        OGRSpatialReferenceH srs = OSRNewSpatialReference(nullptr);
        EXPECT_EQ(OSRSetFromUserInput(srs, spec.crs.c_str()), OGRERR_NONE);
        OSRSetAxisMappingStrategy(srs, OAMS_TRADITIONAL_GIS_ORDER);
        GDALSetSpatialRef(dataset, srs);
        OSRRelease(srs);
    }
    const size_t samples = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
    for (int b = 0; b < spec.bands; ++b) {
        GDALRasterBandH band = GDALGetRasterBand(dataset, b + 1);
        if (spec.has_nodata) GDALSetRasterNoDataValue(band, spec.nodata);
        if (spec.scale != 1.0) GDALSetRasterScale(band, spec.scale);
        if (spec.offset != 0.0) GDALSetRasterOffset(band, spec.offset);
        if (!spec.unit.empty()) GDALSetRasterUnitType(band, spec.unit.c_str());
        std::vector<double> values(
            spec.values.begin() + static_cast<std::ptrdiff_t>(samples * static_cast<size_t>(b)),
            spec.values.begin() + static_cast<std::ptrdiff_t>(samples * static_cast<size_t>(b + 1)));
        EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, spec.width, spec.height, values.data(), spec.width,
                               spec.height, GDT_Float64, 0, 0),
                  CE_None);
    }
    GDALClose(dataset);
    return path;
}

inline std::vector<unsigned char> file_bytes(const std::string& path) {
    std::vector<unsigned char> bytes;
    VSILFILE* file = VSIFOpenL(path.c_str(), "rb");
    EXPECT_NE(file, nullptr) << path;
    if (!file) return bytes;
    VSIFSeekL(file, 0, SEEK_END);
    bytes.resize(VSIFTellL(file));
    VSIFSeekL(file, 0, SEEK_SET);
    EXPECT_EQ(VSIFReadL(bytes.data(), 1, bytes.size(), file), bytes.size());
    VSIFCloseL(file);
    return bytes;
}

/// @returns the path, /vsimem/NAME
inline std::string write_bytes(const std::string& name, const std::vector<unsigned char>& bytes) {
    const std::string path = "/vsimem/" + name;
    VSILFILE* file = VSIFOpenL(path.c_str(), "wb");
    EXPECT_EQ(VSIFWriteL(bytes.data(), 1, bytes.size(), file), bytes.size());
    VSIFCloseL(file);
    return path;
}

/// The folder of real data beside the project; tests skip where a user has none.
inline std::string real_data(const std::string& name) {
    return std::string(HARRIER_SOURCE_DIR) + "/../shared/data/" + name;
}

inline bool exists(const std::string& path) {
    VSIStatBufL status;
    return VSIStatL(path.c_str(), &status) == 0;
}

}  // namespace test
