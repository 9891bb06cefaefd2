#include "sim/depth_tiff.h"

#include <gdal_priv.h>

#include "sim/whole_file.h"

namespace sim {
namespace {

bool write_band(const std::string& path, const render::DepthImage& depth) {
    GDALAllRegister();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    if (!driver) return false;
    GDALDataset* file = driver->Create(path.c_str(), depth.width, depth.height, 1, GDT_Float32, nullptr);
    if (!file) return false;
    auto* pixels = const_cast<float*>(depth.depth_m.data());  // RasterIO takes one pointer for both ways
    const CPLErr written =
        file->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, depth.width, depth.height, pixels, depth.width,
                                         depth.height, GDT_Float32, 0, 0, nullptr);
    CPLErrorReset();
    GDALClose(file);
    return written == CE_None && CPLGetLastErrorType() == CE_None;
}

}  // namespace

lod::Result<lod::Ok> write_depth_tiff(const std::string& path, const render::DepthImage& depth) {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    const auto result = write_whole(path, [&](const std::string& part) { return write_band(part, depth); });
    CPLPopErrorHandler();
    return result;
}

}  // namespace sim
