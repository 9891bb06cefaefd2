// Float4: four floats at once, for loops over candidates that come in small groups.
//
// The compilers' vector extension, so operators work; only what they lack stands here. IEEE results lane by lane:
// the same bits as the scalar operations, on every machine.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
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
#if defined(__SSE__)
    return _mm_movemask_ps(std::bit_cast<Float4>(mask)) != 0;
#else
    return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}
inline Float4 sqrt(Float4 a) {
#if defined(__SSE__)
    return _mm_sqrt_ps(a);
#else
    return Float4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

}  // namespace lod
