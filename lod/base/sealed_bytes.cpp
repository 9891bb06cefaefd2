#include "lod/base/sealed_bytes.h"

#include "lod/base/hash.h"

namespace lod {
namespace {

struct Preamble {
    std::array<char, 8> name{};
    uint64_t version = 0;
    uint64_t size_bytes = 0;  ///< of the whole
    uint64_t checksum = 0;    ///< hash_bytes of the body
};
static_assert(sizeof(Preamble) == 32);

}  // namespace

std::vector<unsigned char> begin_sealed() {
    return std::vector<unsigned char>(sizeof(Preamble));
}

void seal(std::vector<unsigned char>& bytes, const Seal& seal) {
    const uint64_t checksum = hash_bytes(std::span(bytes).subspan(sizeof(Preamble)));
    const Preamble preamble{seal.name, seal.version, bytes.size(), checksum};
    std::memcpy(bytes.data(), &preamble, sizeof(Preamble));
}

Result<std::span<const unsigned char>> unseal(std::span<const unsigned char> bytes, const Seal& seal) {
    const std::string maker = std::string("a file made by '") + seal.make + "'";
    if (bytes.size() < sizeof(Preamble)) return Error{"is too short; expected " + maker};
    Preamble preamble;
    std::memcpy(&preamble, bytes.data(), sizeof(Preamble));
    if (preamble.name != seal.name) return Error{std::string("is not ") + seal.what + "; expected " + maker};
    if (preamble.version != seal.version) {
        return Error{std::string("is ") + seal.what + " of version " + std::to_string(preamble.version) +
                     "; expected version " + std::to_string(seal.version) + ", build it anew"};
    }
    if (preamble.size_bytes != bytes.size()) {
        return Error{"has " + std::to_string(bytes.size()) + " bytes; expected " +
                     std::to_string(preamble.size_bytes) + ", build it anew"};
    }
    const std::span<const unsigned char> body = bytes.subspan(sizeof(Preamble));
    if (hash_bytes(body) != preamble.checksum)
        return Error{"is damaged; expected " + maker + ", build it anew"};
    return body;
}

}  // namespace lod
