#include "data/netcdf_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace data {

namespace {

/// Takes the header apart, front to back. Once it runs out of bytes everything is 0.
class HeaderReader {
  public:
    explicit HeaderReader(std::string_view head) : rest_(head.substr(4)), version_(head[3]) {}

    bool has_failed() const { return has_failed_; }
    uint64_t number(size_t bytes) {
        if (!skip_if_there(bytes)) return 0;
        uint64_t value = 0;
        for (size_t i = 0; i < bytes; ++i)
            value = value << 8 | static_cast<unsigned char>(taken_[i]);
        return value;
    }
    uint64_t count() { return number(version_ == 5 ? 8 : 4); }
    uint64_t offset() { return number(version_ == 1 ? 4 : 8); }
    /// Padded to four bytes.
    void skip_padded(uint64_t bytes) {
        constexpr uint64_t kMost = std::numeric_limits<uint32_t>::max();
        skip_if_there(static_cast<size_t>((std::min(bytes, kMost) + 3) / 4 * 4));
    }
    void skip_name() { skip_padded(count()); }
    /// Of a list: how many elements follow its tag.
    uint64_t list_length() {
        number(4);
        return count();
    }

  private:
    bool skip_if_there(size_t bytes) {
        has_failed_ |= bytes > rest_.size();
        if (has_failed_) return false;
        taken_ = rest_.substr(0, bytes);
        rest_.remove_prefix(bytes);
        return true;
    }

    std::string_view rest_, taken_;
    char version_;
    bool has_failed_ = false;
};

uint64_t bytes_of_type(uint64_t type) {
    constexpr std::array<uint64_t, 12> kBytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return type < kBytes.size() ? kBytes[static_cast<size_t>(type)] : 0;
}

void skip_attributes(HeaderReader& reader) {
    for (uint64_t left = reader.list_length(); left > 0 && !reader.has_failed(); --left) {
        reader.skip_name();
        const uint64_t type = reader.number(4);
        const uint64_t values = std::min<uint64_t>(reader.count(), std::numeric_limits<uint32_t>::max());
        reader.skip_padded(values * bytes_of_type(type));
    }
}

/// @param lengths  of the dimensions; 0 is the one of records
/// @returns where the variable ends
uint64_t take_variable(HeaderReader& reader, const std::vector<uint64_t>& lengths, bool has_records) {
    reader.skip_name();
    uint64_t values = 1;
    bool is_there = true;
    for (uint64_t left = reader.count(); left > 0 && !reader.has_failed(); --left) {
        const uint64_t dimension = reader.count();
        const uint64_t length = dimension < lengths.size() ? lengths[static_cast<size_t>(dimension)] : 0;
        if (length == 0) is_there = has_records;
        values *= std::max<uint64_t>(length, 1);
    }
    skip_attributes(reader);
    const uint64_t type = reader.number(4);
    reader.count();  // the padded size, which is wrong for large variables by design
    const uint64_t begin = reader.offset();
    return is_there ? begin + values * bytes_of_type(type) : 0;
}

}  // namespace

uint64_t netcdf_bytes(std::string_view head) {
    if (head.size() < 4 || head.substr(0, 3) != "CDF") return 0;
    if (head[3] != 1 && head[3] != 2 && head[3] != 5) return 0;
    HeaderReader reader(head);
    const bool has_records = reader.count() > 0;
    std::vector<uint64_t> lengths;
    for (uint64_t left = reader.list_length(); left > 0 && !reader.has_failed(); --left) {
        reader.skip_name();
        lengths.push_back(reader.count());
    }
    skip_attributes(reader);
    uint64_t end = 0;
    for (uint64_t left = reader.list_length(); left > 0 && !reader.has_failed(); --left)
        end = std::max(end, take_variable(reader, lengths, has_records));
    return reader.has_failed() ? kCutHeader_bytes : end;
}

}  // namespace data
