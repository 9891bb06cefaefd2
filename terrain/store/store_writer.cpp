#include "terrain/store/store_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "terrain/store/store_summary.h"

namespace terrain {
namespace {

StoreHeader header_of(const StoreDraft& draft, size_t entry_count) {
    const DiamondTable& table = draft.table;
    StoreHeader header;
    header.width = table.domain.width;
    header.height = table.domain.height;
    header.geo_transform = table.frame.geo_transform();
    header.crs_wkt = table.frame.crs_wkt();
    header.min_m = table.min_m;
    header.max_m = table.max_m;
    header.has_voids = table.has_voids;
    std::copy(table.corners, table.corners + 4, header.corners.begin());
    header.level_m = draft.level_m;
    header.numbers = draft.numbers;
    header.entries.resize(entry_count);
    return header;
}

/// Fills the file at its temporary place. Returns what went wrong; empty when nothing did.
std::string fill_file(StoreDraft& draft, const FileHandle& file, unsigned threads,
                      const std::function<void(DiamondTable&)>& fill) {
    const PageDirectory directory(draft.table.layout, draft.numbers);
    StoreHeader header = header_of(draft, directory.count());
    const uint64_t file_bytes = header.size_bytes() + directory.count() * kPageBytes;
    if (!file.reserve(file_bytes))
        return "cannot be given its " + std::to_string(file_bytes) + " bytes, expected room on disk";
    DiamondTable& table = draft.table;
    table.slots =
        FactMemory::of_file(file.get(), header.size_bytes(), directory.count() * kPageEntries, true);
    if (table.slots.size() == 0) return "cannot be mapped, expected a file system that can";
    table.slot_of_page = directory.slots([](size_t entry) { return static_cast<uint32_t>(entry); });
    fill(table);
    header.entries = summarise(table, directory, draft.level_m, threads);
    const std::string bytes = pack_header(header);
    if (!file.write_at(0, bytes.data(), bytes.size())) return "cannot be written, expected a writable place";
    table.slots = {};
    return file.flush() ? "" : "cannot be written to disk, expected a working file system";
}

}  // namespace

lod::Result<StoreReport> write_store(StoreDraft draft, const std::string& path, unsigned threads,
                                     const std::function<void(DiamondTable&)>& fill) {
    const std::string temporary = path + ".part" + std::to_string(getpid());
    const FileHandle file = FileHandle::for_writing(temporary);
    const std::string where = "terrain store '" + path + "' ";
    if (!file.is_open()) return lod::Error{where + "cannot be written, expected a writable place"};
    std::string fault = fill_file(draft, file, threads, fill);
    if (fault.empty() && std::rename(temporary.c_str(), path.c_str()) != 0)
        fault = "cannot be put in its place, expected a path that can be written";
    if (!fault.empty()) {
        std::remove(temporary.c_str());
        return lod::Error{where + fault};
    }
    return StoreReport{file.size_bytes(), PageDirectory(draft.table.layout, draft.numbers).count()};
}

}  // namespace terrain
