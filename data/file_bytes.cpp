#include "data/file_bytes.h"

#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <limits>

namespace data {

namespace {

constexpr size_t kStep_bytes = size_t{1} << 20;

/// zlib's state, closed with the scope.
struct Inflater {
    z_stream stream{};
    bool is_open = false;

    Inflater() { is_open = inflateInit2(&stream, 15 + 16) == Z_OK; }  // 16: gzip's header and checksum
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
};

/// Unpacks the next member. @returns zlib's last status; Z_STREAM_END when the member is whole
int inflate_member(Inflater& inflater, size_t max_bytes, std::vector<uint8_t>& out) {
    int status = Z_OK;
    while (status == Z_OK && out.size() < max_bytes) {
        const size_t begin = out.size();
        out.resize(begin + kStep_bytes);
        inflater.stream.next_out = out.data() + begin;
        inflater.stream.avail_out = static_cast<unsigned>(kStep_bytes);
        status = inflate(&inflater.stream, Z_NO_FLUSH);
        out.resize(out.size() - inflater.stream.avail_out);
    }
    return status;
}

}  // namespace

lod::Result<std::vector<uint8_t>> read_file(const std::string& path, size_t max_bytes) {
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure))
        return lod::Error{path + ": no such file; expected one that can be read"};
    const uintmax_t size = std::filesystem::file_size(path, failure);
    if (failure) return lod::Error{path + ": " + failure.message() + "; expected a file that can be read"};
    if (size > max_bytes)
        return lod::Error{path + ": too large; expected at most " + std::to_string(max_bytes) + " bytes"};
    std::vector<uint8_t> bytes(static_cast<size_t>(size));
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file)
        return lod::Error{path + ": cannot be read; expected all of its " + std::to_string(size) + " bytes"};
    return bytes;
}

lod::Result<std::vector<uint8_t>> read_gzip_file(const std::string& path, size_t max_bytes) {
    lod::Result<std::vector<uint8_t>> packed = read_file(path, std::numeric_limits<unsigned>::max());
    if (!packed) return packed;
    Inflater inflater;
    inflater.stream.next_in = packed->data();
    inflater.stream.avail_in = static_cast<unsigned>(packed->size());
    std::vector<uint8_t> out;
    do {
        const int status = inflater.is_open ? inflate_member(inflater, max_bytes, out) : Z_MEM_ERROR;
        if (out.size() > max_bytes || status == Z_OK)
            return lod::Error{path + ": too large unpacked; expected at most " + std::to_string(max_bytes) +
                              " bytes"};
        if (status != Z_STREAM_END)
            return lod::Error{path + ": damaged or truncated; expected whole gzip data"};
        inflateReset(&inflater.stream);
    } while (inflater.stream.avail_in > 0 && *inflater.stream.next_in == 0x1f);
    return out;
}

}  // namespace data
