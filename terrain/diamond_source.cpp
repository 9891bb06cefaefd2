#include "terrain/diamond_source.h"

namespace terrain {

uint16_t encode_length(float length_m) {
    if (!(length_m > 0.0f)) return 0;
    constexpr uint32_t kBase = (127u - 13u) << 11;
    const uint32_t bits = (std::bit_cast<uint32_t>(length_m) + 0xfffu) >> 12;
    if (bits <= kBase) return 1;
    return static_cast<uint16_t>(std::min(bits - kBase + 1u, 65535u));
}

}  // namespace terrain
