// A smooth average over a short span of time around an instant: what turns a step of the target attitude into
// the roll-in of a craft with mass. A function of time alone, so a path can be entered anywhere.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace sim {

/// Weighted mean of value(t) for t in [time_s - half_width_s, time_s + half_width_s], raised-cosine weights.
/// @param value  callable (double time_s) -> a type with + and * double
template <typename Value>
auto smoothed(double time_s, double half_width_s, const Value& value) {
    constexpr int kSide = 6;
    auto sum = value(time_s);
    double weights = 1.0;
    for (int i = 1; i <= kSide; ++i) {
        const double offset = static_cast<double>(i) / (kSide + 1);
        const double weight = 0.5 + 0.5 * std::cos(std::numbers::pi * offset);
        sum = sum + (value(time_s - offset * half_width_s) + value(time_s + offset * half_width_s)) * weight;
        weights += 2.0 * weight;
    }
    return sum * (1.0 / weights);
}

}  // namespace sim
