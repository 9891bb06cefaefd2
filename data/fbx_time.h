// FBX time: ticks of 1/46186158000 s in 64 bits.
#pragma once

#include <cmath>
#include <cstdint>

namespace data {

constexpr double kFbxTicksPerS = 46186158000.0;
constexpr double kFbxEndS = 1.99e8;  ///< times within hold in 64 bits

/// CHECK-free: |time_s| <= kFbxEndS.
inline int64_t fbx_ticks(double time_s) {
    return static_cast<int64_t>(std::llround(time_s * kFbxTicksPerS));
}

/// The decimal a tick stands for: exact to 1e-11 s near 0.
inline double fbx_seconds(int64_t ticks) {
    return static_cast<double>(ticks) / kFbxTicksPerS;
}

}  // namespace data
