#include "terrain/store/file_handle.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace terrain {

FileHandle::~FileHandle() {
    if (file_ >= 0) close(file_);
}

FileHandle FileHandle::for_reading(const std::string& path) {
    return FileHandle(open(path.c_str(), O_RDONLY | O_CLOEXEC));
}

FileHandle FileHandle::for_writing(const std::string& path) {
    return FileHandle(open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
}

uint64_t FileHandle::size_bytes() const {
    struct stat status = {};
    if (fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
    return static_cast<uint64_t>(status.st_size);
}

bool FileHandle::read_at(uint64_t offset_bytes, void* out, size_t size_bytes) const {
    char* to = static_cast<char*>(out);
    while (size_bytes > 0) {
        const ssize_t count = pread(file_, to, size_bytes, static_cast<off_t>(offset_bytes));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        to += count;
        offset_bytes += static_cast<uint64_t>(count);
        size_bytes -= static_cast<size_t>(count);
    }
    return true;
}

bool FileHandle::write_at(uint64_t offset_bytes, const void* bytes, size_t size_bytes) const {
    const char* from = static_cast<const char*>(bytes);
    while (size_bytes > 0) {
        const ssize_t count = pwrite(file_, from, size_bytes, static_cast<off_t>(offset_bytes));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        from += count;
        offset_bytes += static_cast<uint64_t>(count);
        size_bytes -= static_cast<size_t>(count);
    }
    return true;
}

bool FileHandle::reserve(uint64_t size_bytes) const {
    return posix_fallocate(file_, 0, static_cast<off_t>(size_bytes)) == 0;
}

bool FileHandle::flush() const {
    return fsync(file_) == 0;
}

}  // namespace terrain
