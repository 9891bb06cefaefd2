// Float4: four floats at once, for loops over candidates that come in small groups.
//
// The compilers' vector extension, so operators work; only what they lack stands here. IEEE results lane by lane:
// the same bits as the scalar operations, on every machine.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace lod {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));  ///< also a mask: 0 or -1 a lane

inline Float4 splat(float value) {
    return Float4{value, value, value, value};
}
inline Float4 min(Float4 a, Float4 b) {
    return a < b ? a : b;
}
inline Float4 max(Float4 a, Float4 b) {
    return a > b ? a : b;
}
inline Float4 abs(Float4 a) {
    return std::bit_cast<Float4>(std::bit_cast<Int4>(a) & 0x7fffffff);
}
/// Whether any lane of a mask is set.
inline bool any(Int4 mask) {
#if defined(__SSE2__)
    return _mm_movemask_ps(std::bit_cast<Float4>(mask)) != 0;
#else
    return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}
inline Float4 sqrt(Float4 a) {
#if defined(__SSE2__)
    return _mm_sqrt_ps(a);
#else
    return Float4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}
/// 2^n for whole numbers 0 … 30.
inline Int4 power_of_two(Float4 n) {
    const Int4 exponent = __builtin_convertvector(n, Int4) + 127;
    return __builtin_convertvector(std::bit_cast<Float4>(exponent << 23), Int4);
}
/// Eight numbers 0 … 255 as bytes, the first the lowest.
inline uint64_t bytes_of(Int4 low, Int4 high) {
#if defined(__SSE2__)
    const __m128i pairs = _mm_packs_epi32(std::bit_cast<__m128i>(low), std::bit_cast<__m128i>(high));
    return std::bit_cast<uint64_t>(_mm_cvtsi128_si64(_mm_packus_epi16(pairs, pairs)));
#else
    uint64_t bytes = 0;
    for (int i = 0; i < 4; ++i)
        bytes |= uint64_t(uint32_t(low[i])) << (8 * i) | uint64_t(uint32_t(high[i])) << (8 * i + 32);
    return bytes;
#endif
}

}  // namespace lod
