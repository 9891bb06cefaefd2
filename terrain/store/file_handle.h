// FileHandle: an open file, read and written at places, from any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace terrain {

/// Move-only; closes what it holds.
class FileHandle {
  public:
    FileHandle() = default;
    FileHandle(FileHandle&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    FileHandle& operator=(FileHandle&& other) noexcept {
        std::swap(file_, other.file_);
        return *this;
    }
    ~FileHandle();

    /// Not open when the system refuses.
    static FileHandle for_reading(const std::string& path);
    /// An empty file, whatever was there.
    static FileHandle for_writing(const std::string& path);

    bool is_open() const { return file_ >= 0; }
    int get() const { return file_; }
    /// 0 when it cannot be told.
    uint64_t size_bytes() const;

    /// False when not all of it could be read or written.
    bool read_at(uint64_t offset_bytes, void* out, size_t size_bytes) const;
    bool write_at(uint64_t offset_bytes, const void* bytes, size_t size_bytes) const;
    /// Makes the file this long, with the room on disk to fill it; false when there is none.
    bool reserve(uint64_t size_bytes) const;
    /// Everything written is on disk.
    bool flush() const;

  private:
    explicit FileHandle(int file) : file_(file) {}

    int file_ = -1;
};

}  // namespace terrain
