#include "terrain/store/store_file.h"

namespace terrain {

StoreFile::StoreFile(std::string path, FileHandle file, StoreHeader header, data::GroundFrame frame)
    : path_(std::move(path)),
      file_(std::move(file)),
      header_(std::move(header)),
      frame_(std::move(frame)),
      directory_(PageLayout(make_domain(header_.width, header_.height)), header_.numbers) {}

lod::Result<StoreFile> StoreFile::open(const std::string& path) {
    FileHandle file = FileHandle::for_reading(path);
    auto header = read_header(file, path);
    if (!header) return header.error();
    auto frame =
        data::GroundFrame::make(header->geo_transform, header->crs_wkt, header->width, header->height);
    if (!frame) return lod::Error{"terrain store '" + path + "': " + frame.message()};
    return StoreFile(path, std::move(file), std::move(*header), std::move(*frame));
}

DiamondTable StoreFile::make_table() const {
    DiamondTable table{.domain = domain(),
                       .layout = layout(),
                       .frame = frame_,
                       .min_m = header_.min_m,
                       .max_m = header_.max_m,
                       .has_voids = header_.has_voids,
                       .corners = {},
                       .slot_of_page = directory_.slots([](size_t) { return DiamondTable::kAbsent; }),
                       .slots = {}};
    std::copy(header_.corners.begin(), header_.corners.end(), table.corners);
    return table;
}

lod::Result<DiamondTable> StoreFile::map_table() const {
    DiamondTable table = make_table();
    table.slots =
        FactMemory::of_file(file_.get(), header_.size_bytes(), directory_.count() * kPageEntries, false);
    if (table.slots.size() == 0)
        return lod::Error{"terrain store '" + path_ + "' cannot be mapped, expected address space for it"};
    table.slot_of_page = directory_.slots([](size_t entry) { return static_cast<uint32_t>(entry); });
    return table;
}

lod::Result<lod::Ok> StoreFile::read_page(size_t entry, std::span<DiamondSource> out) const {
    CHECK(entry < directory_.count() && out.size() == kPageEntries);
    const std::string where = "terrain store '" + path_ + "': page " + std::to_string(entry) + " ";
    if (!file_.read_at(header_.size_bytes() + entry * kPageBytes, out.data(), kPageBytes))
        return lod::Error{where + "cannot be read, expected a file as long as when it was opened"};
    if (checksum_of(out.data(), kPageBytes) != header_.entries[entry].checksum)
        return lod::Error{where + "is damaged, expected the bytes its checksum was made of; build it anew"};
    return lod::Ok{};
}

}  // namespace terrain
