// Integer mixing and a running 64-bit hash for decisions, fronts and golden tests. Not for adversaries.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace lod {

/// A bijection on 64 bits with full avalanche (the finaliser of splitmix64).
/// Source: Steele, Lea, Flood, Fast splittable pseudorandom number generators (2014).
constexpr uint64_t mix64(uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Folds `value` into `hash`; order matters.
constexpr uint64_t hash_combine(uint64_t hash, uint64_t value) {
    return mix64(hash ^ (value + 0x9e3779b97f4a7c15u + (hash << 6) + (hash >> 2)));
}

/// Hash of raw bytes; the same on every little-endian machine. A change within one word of eight bytes never
/// goes unnoticed. Four words at a
/// time, side by side, so that it costs less than writing them.
inline uint64_t hash_bytes(std::span<const unsigned char> bytes, uint64_t hash = 0) {
    std::array<uint64_t, 4> lanes{hash + 1, hash + 2, hash + 3, hash + 4};
    const auto take = [&lanes](const unsigned char* block) {
        std::array<uint64_t, 4> words;
        std::memcpy(words.data(), block, sizeof(words));
        for (size_t i = 0; i < 4; ++i)
            lanes[i] = std::rotl((lanes[i] ^ words[i]) * 0x9e3779b97f4a7c15u, 29);
    };
    const size_t whole = bytes.size() / 32 * 32;
    for (size_t at = 0; at < whole; at += 32)
        take(bytes.data() + at);
    std::array<unsigned char, 32> rest{};
    std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(whole), bytes.end(), rest.begin());
    take(rest.data());
    uint64_t all = bytes.size();
    for (uint64_t lane : lanes)
        all = hash_combine(all, lane);
    return all;
}

}  // namespace lod
