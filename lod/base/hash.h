// Integer mixing and a running 64-bit hash for decisions, fronts and golden tests. Not for adversaries.
#pragma once

#include <bit>
#include <cstdint>
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

/// Hash of raw bytes; the same on every little-endian machine.
inline uint64_t hash_bytes(std::span<const unsigned char> bytes, uint64_t hash = 0) {
    for (unsigned char byte : bytes)
        hash = (hash ^ byte) * 0x100000001b3u;
    return mix64(hash);
}

}  // namespace lod
