// DiamondSource: one diamond's facts in eight bytes; lengths as 16-bit logarithms that are rounded up.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "lod/base/float4.h"

namespace terrain {

/// Metres to a 16-bit logarithm, rounded up; 0 only for 0. Anything below 0.12 mm becomes 0.12 mm; above 524 km
/// saturates.
inline uint16_t encode_length(float length_m) {
    if (!(length_m > 0.0f)) return 0;
    constexpr uint32_t kBase = (127u - 13u) << 11;
    const uint32_t bits = (std::bit_cast<uint32_t>(length_m) + 0xfffu) >> 12;
    if (bits <= kBase) return 1;
    return static_cast<uint16_t>(std::min(bits - kBase + 1u, 65535u));
}

/// Metres of a code; decode(encode(x)) is in [x, 1.0005 x] for 0.12 mm <= x <= 524 km.
inline float decode_length(uint16_t code) {
    constexpr uint32_t kBase = (127u - 13u) << 11;
    return code == 0 ? 0.0f : std::bit_cast<float>((kBase + code - 1u) << 12);
}

/// Four at a time.
inline lod::Float4 decode_lengths(lod::Int4 codes) {
    constexpr int32_t kBase = (127 - 13) << 11;
    return codes == 0 ? lod::Float4{} : std::bit_cast<lod::Float4>((codes + (kBase - 1)) << 12);
}

/// One diamond's facts.
struct DiamondSource {
    float height_m = 0.0f;        ///< of the centre
    uint16_t error_code = 0;      ///< decode_length: vertical error of the two triangles, saturated
    uint16_t rise_and_voids = 0;  ///< above bit 3, a length code without its low bits; below, what is void

    static constexpr uint16_t kVoidCentre = 4;

    float error_m() const { return decode_length(error_code); }
    /// Largest height difference between the centre and a corner, rounded up.
    float rise_m() const { return decode_length(rise_code()); }
    uint16_t rise_code() const { return rise_and_voids & 0xfff8u; }
    void set_rise(float rise_m) {
        const unsigned code = std::min((encode_length(rise_m) + 7u) & ~7u, 0xfff8u);
        rise_and_voids = static_cast<uint16_t>(code | (rise_and_voids & 7u));
    }
    /// Whether the triangle whose apex lies in this direction covers no valid sample at all.
    bool is_half_empty(int apex_dir) const { return (rise_and_voids >> ((apex_dir >> 2) & 1) & 1) != 0; }
    void set_half_empty(int apex_dir) {
        rise_and_voids = static_cast<uint16_t>(rise_and_voids | (1u << ((apex_dir >> 2) & 1)));
    }
    bool is_void() const { return (rise_and_voids & kVoidCentre) != 0; }
};
static_assert(sizeof(DiamondSource) == 8);

}  // namespace terrain
