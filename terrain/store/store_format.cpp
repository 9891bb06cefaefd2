#include "terrain/store/store_format.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "terrain/store/page_directory.h"

namespace terrain {
namespace {

static_assert(std::endian::native == std::endian::little,
              "stores are read and written as they lie in memory");

constexpr std::array<char, 8> kName = {'H', 'a', 'r', 'r', 'i', 'e', 'r', 'T'};
constexpr uint32_t kVersion = 2;
constexpr uint32_t kMostCrs_bytes = 1u << 20;
constexpr uint64_t kMostPages = 0xffffff00u;  // that a 32-bit entry can name

struct Preamble {
    std::array<char, 8> name = kName;
    uint32_t version = kVersion;
    uint32_t checksum = 0;  ///< of everything from here to the pages
    uint64_t header_bytes = 0, file_bytes = 0;
    int32_t width = 0, height = 0;
    std::array<double, 6> geo_transform{};
    float min_m = 0.0f, max_m = 0.0f;
    uint32_t has_voids = 0, crs_bytes = 0;
    std::array<DiamondSource, 4> corners{};
    float level_m = 0.0f;
    uint32_t level_count = 0;  ///< level pages
    uint64_t page_count = 0;   ///< pages held, level pages not among them
};
static_assert(sizeof(Preamble) == 152);
constexpr size_t kChecked_bytes = offsetof(Preamble, checksum) + sizeof(uint32_t);

/// Numbers are told only where pages are left out.
uint64_t directory_bytes(uint64_t level_count, uint64_t page_count) {
    return (level_count + page_count) * sizeof(PageSummary) +
           (level_count > 0 ? page_count * sizeof(uint64_t) : 0);
}

uint64_t header_bytes(uint64_t crs_bytes, uint64_t level_count, uint64_t page_count) {
    const uint64_t used = sizeof(Preamble) + crs_bytes + directory_bytes(level_count, page_count);
    return (used + kStoreAlignment_bytes - 1) / kStoreAlignment_bytes * kStoreAlignment_bytes;
}

bool is_side_sane(int32_t side) {
    return side >= 2 && side <= (1 << kMostLog2Side) + 1;
}

/// What a preamble claims, before anything is allocated for it; empty when it can be.
std::string fault_of(const Preamble& preamble, uint64_t size_bytes) {
    if (preamble.name != kName) return "is no terrain store, expected a file made by 'harrier terrain build'";
    if (preamble.version != kVersion) {
        return "is a terrain store of version " + std::to_string(preamble.version) + ", expected version " +
               std::to_string(kVersion) + "; build it anew";
    }
    const std::string damaged = "has a damaged header, expected a whole terrain store; build it anew";
    if (!is_side_sane(preamble.width) || !is_side_sane(preamble.height) ||
        preamble.crs_bytes > kMostCrs_bytes)
        return damaged;
    const PageLayout layout(make_domain(preamble.width, preamble.height));
    const bool lacks_some = preamble.level_count > 0;
    const bool is_count_sane =
        lacks_some ? preamble.level_count == static_cast<uint32_t>(layout.group_count()) &&
                         preamble.page_count < layout.page_count() && preamble.page_count < kMostPages
                   : preamble.page_count == layout.page_count();
    if (!is_count_sane) return damaged;
    const uint64_t header = header_bytes(preamble.crs_bytes, preamble.level_count, preamble.page_count);
    const uint64_t entries = preamble.level_count + preamble.page_count;
    if (preamble.header_bytes != header || preamble.file_bytes != header + entries * kPageBytes)
        return damaged;
    if (size_bytes != preamble.file_bytes) {
        return "has " + std::to_string(size_bytes) + " bytes, expected " +
               std::to_string(preamble.file_bytes) + "; build it anew";
    }
    return "";
}

}  // namespace

uint32_t checksum_of(const void* bytes, size_t size_bytes) {
    return static_cast<uint32_t>(crc32_z(0, static_cast<const Bytef*>(bytes), size_bytes));
}

uint64_t StoreHeader::size_bytes() const {
    return header_bytes(crs_wkt.size(), entries.size() - numbers.size(), numbers.size());
}

std::string pack_header(const StoreHeader& header) {
    Preamble preamble;
    preamble.header_bytes = header.size_bytes();
    preamble.file_bytes = preamble.header_bytes + header.entries.size() * kPageBytes;
    preamble.width = header.width;
    preamble.height = header.height;
    preamble.geo_transform = header.geo_transform;
    preamble.min_m = header.min_m;
    preamble.max_m = header.max_m;
    preamble.has_voids = header.has_voids ? 1 : 0;
    preamble.crs_bytes = static_cast<uint32_t>(header.crs_wkt.size());
    preamble.corners = header.corners;
    preamble.level_m = header.level_m;
    preamble.level_count = static_cast<uint32_t>(header.entries.size() - header.numbers.size());
    preamble.page_count = header.numbers.size();
    std::string bytes(preamble.header_bytes, '\0');
    char* crs = bytes.data() + sizeof(Preamble);
    std::memcpy(bytes.data(), &preamble, sizeof(Preamble));
    std::memcpy(crs, header.crs_wkt.data(), header.crs_wkt.size());
    char* directory = crs + header.crs_wkt.size();
    std::memcpy(directory, header.entries.data(), header.entries.size() * sizeof(PageSummary));
    directory += header.entries.size() * sizeof(PageSummary);
    if (preamble.level_count > 0)
        std::memcpy(directory, header.numbers.data(), header.numbers.size() * sizeof(uint64_t));
    preamble.checksum = checksum_of(bytes.data() + kChecked_bytes, bytes.size() - kChecked_bytes);
    std::memcpy(bytes.data(), &preamble, sizeof(Preamble));
    return bytes;
}

bool is_store(const std::string& path) {
    const FileHandle file = FileHandle::for_reading(path);
    std::array<char, 8> name{};
    return file.is_open() && file.read_at(0, name.data(), name.size()) && name == kName;
}

lod::Result<StoreHeader> read_header(const FileHandle& file, const std::string& path) {
    const std::string where = "terrain store '" + path + "' ";
    Preamble preamble;
    if (!file.is_open()) return lod::Error{where + "cannot be opened, expected a readable file"};
    if (!file.read_at(0, &preamble, sizeof(Preamble)))
        return lod::Error{where + "is too short, expected a file made by 'harrier terrain build'"};
    if (std::string fault = fault_of(preamble, file.size_bytes()); !fault.empty())
        return lod::Error{where + fault};
    std::string bytes(preamble.header_bytes, '\0');
    if (!file.read_at(0, bytes.data(), bytes.size()))
        return lod::Error{where + "cannot be read to the end of its header, expected a readable file"};
    if (checksum_of(bytes.data() + kChecked_bytes, bytes.size() - kChecked_bytes) != preamble.checksum)
        return lod::Error{where + "has a damaged header, expected a whole terrain store; build it anew"};

    StoreHeader header;
    header.width = preamble.width;
    header.height = preamble.height;
    header.geo_transform = preamble.geo_transform;
    header.crs_wkt.assign(bytes, sizeof(Preamble), preamble.crs_bytes);
    header.min_m = preamble.min_m;
    header.max_m = preamble.max_m;
    header.has_voids = preamble.has_voids != 0;
    header.corners = preamble.corners;
    header.level_m = preamble.level_m;
    header.entries.resize(preamble.level_count + preamble.page_count);
    header.numbers.resize(preamble.page_count);
    const char* directory = bytes.data() + sizeof(Preamble) + preamble.crs_bytes;
    std::memcpy(header.entries.data(), directory, header.entries.size() * sizeof(PageSummary));
    if (preamble.level_count == 0) {
        std::iota(header.numbers.begin(), header.numbers.end(), uint64_t{0});
        return header;
    }
    std::memcpy(header.numbers.data(), directory + header.entries.size() * sizeof(PageSummary),
                header.numbers.size() * sizeof(uint64_t));
    if (!PageDirectory::is_sound(PageLayout(make_domain(header.width, header.height)), header.numbers))
        return lod::Error{where + "has a damaged header, expected a whole terrain store; build it anew"};
    return header;
}

}  // namespace terrain
