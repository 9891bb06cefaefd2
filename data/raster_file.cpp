#include "data/raster_file.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <ogr_srs_api.h>

#include <optional>
#include <vector>

#include "data/stated_length.h"

namespace data {

namespace {

bool ends_with(const std::string& text, const std::string& tail) {
    return text.size() >= tail.size() && EQUAL(text.c_str() + text.size() - tail.size(), tail.c_str());
}

// What GDAL is to try, in order. Drivers such as SRTM's read the place from the name of the file inside.
std::vector<std::string> names_to_try(const std::string& path) {
    if (ends_with(path, ".gz") && !ends_with(path, ".tar.gz")) return {"/vsigzip/" + path};
    if (!ends_with(path, ".zip")) return {path};
    const std::string archive = "/vsizip/" + path;
    std::vector<std::string> names;
    char** entries = VSIReadDirRecursive(archive.c_str());
    for (int i = 0; i < CSLCount(entries); ++i) {
        const std::string entry = entries[i];
        if (!ends_with(entry, "/")) names.push_back(archive + "/" + entry);
    }
    CSLDestroy(entries);
    if (names.empty()) names.push_back(archive);
    return names;
}

bool read_geo_transform(GDALDatasetH dataset, std::array<double, 6>& out) {
    if (GDALGetGeoTransform(dataset, out.data()) == CE_None) return true;
    constexpr int kApproximate = FALSE;
    const int points = GDALGetGCPCount(dataset);
    return points > 0 && GDALGCPsToGeoTransform(points, GDALGetGCPs(dataset), out.data(), kApproximate);
}

std::string read_crs(GDALDatasetH dataset) {
    OGRSpatialReferenceH srs = GDALGetSpatialRef(dataset);
    if (!srs) srs = GDALGetGCPSpatialRef(dataset);
    if (!srs) return {};
    char* text = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    const bool is_good = OSRExportToWktEx(srs, &text, options) == OGRERR_NONE && text;
    const std::string wkt = is_good ? text : "";
    CPLFree(text);
    return wkt;
}

}  // namespace

lod::Result<RasterFile> open_raster(const std::string& path, const std::string& what) {
    const GdalMessages messages;
    RasterFile file;
    file.path = path;
    for (const std::string& name : names_to_try(path)) {
        constexpr unsigned kFlags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
        file.dataset.reset(GDALOpenEx(name.c_str(), kFlags, nullptr, nullptr, nullptr));
        if (file.dataset && file.band_count() > 0) {
            const std::optional<std::string> problem = length_problem(file.dataset.get(), name);
            if (problem) return lod::Error{what + " '" + path + "': " + *problem};
            break;
        }
        file.dataset.reset();
    }
    if (!file.dataset) {
        return lod::Error{what + " '" + path + "': " + messages.text("no raster bands") +
                          "; expected a raster that GDAL reads"};
    }
    file.width = GDALGetRasterXSize(file.dataset.get());
    file.height = GDALGetRasterYSize(file.dataset.get());
    file.has_place = read_geo_transform(file.dataset.get(), file.geo_transform);
    if (file.has_place) {
        file.crs_wkt = read_crs(file.dataset.get());
    } else {
        file.geo_transform = {0.0, 1.0, 0.0, static_cast<double>(file.height), 0.0, -1.0};
    }
    return file;
}

}  // namespace data
