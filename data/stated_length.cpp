#include "data/stated_length.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "data/netcdf_header.h"

namespace data {

namespace {

struct FileCloser {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

/// A file's size and some of its bytes.
class FileProbe {
  public:
    explicit FileProbe(const std::string& path) {
        VSIStatBufL status;  // folders can be opened too
        if (VSIStatL(path.c_str(), &status) != 0 || !VSI_ISREG(status.st_mode)) return;
        file_.reset(VSIFOpenL(path.c_str(), "rb"));
        if (file_ && VSIFSeekL(file_.get(), 0, SEEK_END) == 0) size_ = VSIFTellL(file_.get());
    }
    bool is_open() const { return file_ != nullptr; }
    uint64_t size() const { return size_; }

    /// As many of the bytes as there are.
    std::string read(uint64_t at, size_t count) const {
        std::string bytes(count, '\0');
        VSIFSeekL(file_.get(), at, SEEK_SET);
        bytes.resize(VSIFReadL(bytes.data(), 1, count, file_.get()));
        return bytes;
    }

  private:
    std::unique_ptr<VSILFILE, FileCloser> file_;
    uint64_t size_ = 0;
};

uint32_t big_endian(std::string_view bytes, size_t at, size_t count) {
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// SQLite's header counts its pages; where an old program left the count stale, two counters differ.
uint64_t sqlite_bytes(const FileProbe& file) {
    constexpr size_t kHeader_bytes = 100, kPageSize = 16, kChanges = 24, kPages = 28, kPagesValidFor = 92;
    const std::string header = file.read(0, kHeader_bytes);
    if (header.size() < kHeader_bytes || header.compare(0, 6, "SQLite") != 0) return 0;
    if (big_endian(header, kChanges, 4) != big_endian(header, kPagesValidFor, 4)) return 0;
    const uint64_t stated = big_endian(header, kPageSize, 2);
    return (stated == 1 ? 65536 : stated) * big_endian(header, kPages, 4);
}

/// Bare pixels behind a header that another file describes.
uint64_t envi_bytes(GDALDatasetH dataset) {
    const char* packing = GDALGetMetadataItem(dataset, "file_compression", "ENVI");
    if (packing != nullptr && std::string_view(packing) != "0") return 0;
    const char* offset = GDALGetMetadataItem(dataset, "header_offset", "ENVI");
    const auto count = [](int number) { return static_cast<uint64_t>(number); };
    const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(dataset, 1));
    return (offset == nullptr ? 0 : std::strtoull(offset, nullptr, 10)) +
           count(GDALGetRasterXSize(dataset)) * count(GDALGetRasterYSize(dataset)) *
               count(GDALGetRasterCount(dataset)) * count(GDALGetDataTypeSizeBytes(type));
}

/// OGR reads a shapefile whose table is empty as one that has none.
bool has_empty_table(const std::string& path) {
    constexpr uint64_t kHeader_bytes = 32;
    for (const char* extension : {"dbf", "DBF"}) {
        const FileProbe table(CPLResetExtension(path.c_str(), extension));
        if (table.is_open()) return table.size() < kHeader_bytes;
    }
    return false;
}

/// The bytes the format states; 0 where it states none.
uint64_t stated_bytes(GDALDatasetH dataset, std::string_view driver, const FileProbe& file) {
    constexpr size_t kNetcdfHeader_bytes = size_t{1} << 20;
    if (driver == "SQLite" || driver == "GPKG") return sqlite_bytes(file);
    if (driver == "netCDF") return netcdf_bytes(file.read(0, kNetcdfHeader_bytes));
    if (driver == "ENVI") return envi_bytes(dataset);
    return 0;
}

}  // namespace

std::optional<std::string> length_problem(GDALDatasetH dataset, const std::string& path) {
    GDALDriverH handle = GDALGetDatasetDriver(dataset);
    const FileProbe file(path);
    if (handle == nullptr || !file.is_open() || file.size() == 0) return std::nullopt;
    const std::string_view driver = GDALGetDriverShortName(handle);
    if (driver == "CSV" || driver == "GeoJSONSeq" || driver == "XYZ") {
        const std::string last = file.read(file.size() - 1, 1);
        if (last == "\n" || last == "\r") return std::nullopt;
        return "truncated, it seems: the last line has no end; expected a line break at the end of the file";
    }
    if (driver == "ESRI Shapefile" && has_empty_table(path))
        return "its .dbf is truncated; expected at least a header there";
    const uint64_t wanted = stated_bytes(dataset, driver, file);
    if (wanted <= file.size()) return std::nullopt;
    if (wanted == kCutHeader_bytes) return "truncated in its header";
    return "truncated: " + std::to_string(file.size()) + " bytes; expected " + std::to_string(wanted) +
           ", as its header says";
}

}  // namespace data
