// A DEM as GDAL, PROJ and GeographicLib see it: the truth that drawn terrain is measured against. Shares no code
// with data/.
#pragma once

#include <gdal.h>
#include <ogr_srs_api.h>

#include <GeographicLib/Geocentric.hpp>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace terrain_test {

/// Where a sample lies: the point at height 0 and the ellipsoid's normal there; ECEF.
struct TrueGround {
    glm::dvec3 base{0.0};
    glm::dvec3 up{0.0, 0.0, 1.0};
};

struct DemTruth {
    int width = 0, height = 0;
    std::vector<double> height_m;     ///< [height * width]; NaN where the file has no measurement
    std::vector<glm::dvec2> lon_lat;  ///< degrees; projected rasters only
    std::array<double, 6> geo{};      ///< of the pixels' corners
    bool is_projected = false;

    size_t index(int col, int row) const {
        return static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(col);
    }
    bool is_valid(int col, int row) const { return !std::isnan(height_m[index(col, row)]); }
    bool contains(int col, int row) const { return col >= 0 && row >= 0 && col < width && row < height; }

    glm::dvec2 crs_xy(int col, int row) const {
        const double c = col + 0.5, r = row + 0.5;
        return {geo[0] + c * geo[1] + r * geo[2], geo[3] + c * geo[4] + r * geo[5]};
    }
    glm::dvec2 site(int col, int row) const {
        return is_projected ? lon_lat[index(col, row)] : crs_xy(col, row);
    }
    TrueGround ground(int col, int row) const {
        const glm::dvec2 at = site(col, row);
        std::vector<double> m(9);
        TrueGround out;
        GeographicLib::Geocentric::WGS84().Forward(at.y, at.x, 0.0, out.base.x, out.base.y, out.base.z, m);
        out.up = {m[2], m[5], m[8]};
        return out;
    }
};

/// Longitudes and latitudes of all samples of a projected raster, by PROJ.
inline bool project_all(OGRSpatialReferenceH from, DemTruth& dem) {
    OGRSpatialReferenceH wgs84 = OSRNewSpatialReference(nullptr);
    OSRImportFromEPSG(wgs84, 4326);
    OSRSetAxisMappingStrategy(wgs84, OAMS_TRADITIONAL_GIS_ORDER);
    OGRCoordinateTransformationH transform = OCTNewCoordinateTransformation(from, wgs84);
    bool is_ok = transform != nullptr;
    std::vector<double> x, y;
    for (int row = 0; row < dem.height; ++row) {
        for (int col = 0; col < dem.width; ++col) {
            x.push_back(dem.crs_xy(col, row).x);
            y.push_back(dem.crs_xy(col, row).y);
        }
    }
    is_ok = is_ok && OCTTransform(transform, static_cast<int>(x.size()), x.data(), y.data(), nullptr) != 0;
    for (size_t i = 0; i < x.size(); ++i)
        dem.lon_lat.emplace_back(x[i], y[i]);
    OCTDestroyCoordinateTransformation(transform);
    OSRDestroySpatialReference(wgs84);
    return is_ok;
}

/// Reads a north-up raster in metres with a CRS; false when that is not what the file holds.
inline bool read_truth(const std::string& path, DemTruth& dem) {
    GDALAllRegister();
    GDALDatasetH file = GDALOpen(path.c_str(), GA_ReadOnly);
    if (file == nullptr) return false;
    dem.width = GDALGetRasterXSize(file);
    dem.height = GDALGetRasterYSize(file);
    dem.height_m.resize(static_cast<size_t>(dem.width) * static_cast<size_t>(dem.height));
    GDALRasterBandH band = GDALGetRasterBand(file, 1);
    bool is_ok = GDALGetGeoTransform(file, dem.geo.data()) == CE_None;
    is_ok = is_ok && GDALRasterIO(band, GF_Read, 0, 0, dem.width, dem.height, dem.height_m.data(), dem.width,
                                  dem.height, GDT_Float64, 0, 0) == CE_None;
    int has_nodata = 0;
    const double nodata = GDALGetRasterNoDataValue(band, &has_nodata);
    for (double& height : dem.height_m) {
        if ((has_nodata != 0 && height == nodata) || height == -32768.0) height = std::nan("");
    }
    OGRSpatialReferenceH crs = OSRClone(GDALGetSpatialRef(file));
    OSRSetAxisMappingStrategy(crs, OAMS_TRADITIONAL_GIS_ORDER);
    dem.is_projected = OSRIsProjected(crs) != 0;
    if (is_ok && dem.is_projected) is_ok = project_all(crs, dem);
    OSRDestroySpatialReference(crs);
    GDALClose(file);
    return is_ok && dem.geo[5] < 0.0;
}

}  // namespace terrain_test
