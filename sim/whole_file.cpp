#include "sim/whole_file.h"

#include <filesystem>
#include <fstream>

namespace sim {
namespace {

std::string part_of(const std::string& path) {
    return path + ".part";
}

lod::Error cannot_write(const std::string& path) {
    return lod::Error{path + ": cannot be written, expected a writable folder with room"};
}

}  // namespace

lod::Result<lod::Ok> write_whole(const std::string& path,
                                 const std::function<bool(const std::string&)>& write) {
    const std::string part = part_of(path);
    std::error_code problem;
    if (!write(part)) {
        std::filesystem::remove(part, problem);
        return cannot_write(path);
    }
    std::filesystem::rename(part, path, problem);
    if (!problem) return lod::Ok{};
    std::filesystem::remove(part, problem);
    return cannot_write(path);
}

lod::Result<lod::Ok> write_whole(const std::string& path, std::string_view bytes) {
    return write_whole(path, [&](const std::string& part) {
        std::ofstream stream(part, std::ios::binary | std::ios::trunc);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        stream.close();
        return !stream.fail();
    });
}

lod::Result<lod::Ok> make_folder(const std::string& path) {
    std::error_code problem;
    std::filesystem::create_directories(path, problem);
    if (std::filesystem::is_directory(path, problem)) return lod::Ok{};
    return lod::Error{path + ": cannot be made, expected a place for a folder"};
}

lod::Result<lod::Ok> check_writable(const std::string& path) {
    std::error_code problem;
    if (std::filesystem::is_directory(path, problem)) return cannot_write(path);
    const std::string part = part_of(path);
    const bool is_good = std::ofstream(part, std::ios::app).good();
    std::filesystem::remove(part, problem);
    if (!is_good) return cannot_write(path);
    return lod::Ok{};
}

}  // namespace sim
