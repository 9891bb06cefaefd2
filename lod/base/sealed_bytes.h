// Sealed bytes: what a file of ours is made of: a preamble that says whose it is, then values and arrays as they lie in
// memory, arrays behind their length.
//
//     preamble    name, version, length of the whole, checksum of all that follows     32 bytes
//     body        values and arrays
//
// Little-endian. Whatever is cut, flipped or from elsewhere is told before it is used; nothing is allocated that the
// bytes at hand cannot fill.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "lod/base/result.h"

namespace lod {

static_assert(std::endian::native == std::endian::little, "files are read and written as they lie in memory");

/// Whose bytes they are.
struct Seal {
    std::array<char, 8> name;  ///< the first bytes of the file
    uint64_t version;
    const char* what;  ///< for messages: "a progressive mesh"
    const char* make;  ///< … and what makes one: "harrier mesh build"
};

/// Appends values; arrays behind their length. Begin with begin_sealed, end with seal.
class ByteWriter {
  public:
    explicit ByteWriter(std::vector<unsigned char>& bytes) : bytes_(bytes) {}

    template <typename Value>
    void value(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        raw(&value, sizeof(Value));
    }
    template <typename Array>
    void array(const Array& array) {
        static_assert(std::is_trivially_copyable_v<typename Array::value_type>);
        value(static_cast<uint64_t>(array.size()));
        if (!array.empty()) raw(array.data(), array.size() * sizeof(array[0]));
    }

  private:
    void raw(const void* from, size_t size) {
        const auto* begin = static_cast<const unsigned char*>(from);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }
    std::vector<unsigned char>& bytes_;
};

/// Takes values off the front; after the first that is not there, everything is left as it was and is_whole() is
/// false.
class ByteReader {
  public:
    explicit ByteReader(std::span<const unsigned char> bytes) : rest_(bytes) {}

    template <typename Value>
    void value(Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        raw(&value, sizeof(Value));
    }
    template <typename Array>
    void array(Array& array) {
        static_assert(std::is_trivially_copyable_v<typename Array::value_type>);
        uint64_t count = 0;
        value(count);
        if (count > rest_.size() / sizeof(array[0])) is_whole_ = false;
        if (!is_whole_) return;
        array.resize(count);
        if (count > 0) raw(array.data(), count * sizeof(array[0]));
    }

    bool is_whole() const { return is_whole_; }
    /// All there and all taken.
    bool is_done() const { return is_whole_ && rest_.empty(); }

  private:
    void raw(void* to, size_t size) {
        if (!is_whole_ || size > rest_.size()) {
            is_whole_ = false;
            return;
        }
        std::memcpy(to, rest_.data(), size);
        rest_ = rest_.subspan(size);
    }
    std::span<const unsigned char> rest_;
    bool is_whole_ = true;
};

/// Room for the preamble; write behind it.
std::vector<unsigned char> begin_sealed();

/// Fills in the preamble of what begin_sealed began.
void seal(std::vector<unsigned char>& bytes, const Seal& seal);

/// The body. Fails with "what; expected what", without the file's name, on anything but the whole of what `seal` names.
/// Cost: about 1 ns a byte.
Result<std::span<const unsigned char>> unseal(std::span<const unsigned char> bytes, const Seal& seal);

}  // namespace lod
