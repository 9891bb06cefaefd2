// Signals: the flight's figures that drive needles and drums.
#pragma once

#include <array>
#include <string_view>

namespace sim {

/// The names a scene file may use, in the order of Signals::value.
inline constexpr std::array<std::string_view, 8> kSignalNames = {
    "altitude_m", "height_m", "airspeed_mps",       "heading_deg",
    "pitch_deg",  "roll_deg", "vertical_speed_mps", "time_s"};

/// One value per name: height above the datum and above the ground, speed along the path, attitude, climb,
/// time.
struct Signals {
    std::array<double, kSignalNames.size()> value{};
};

/// The index of a signal's name, or -1.
constexpr int signal_index(std::string_view name) {
    for (size_t i = 0; i < kSignalNames.size(); ++i) {
        if (kSignalNames[i] == name) return static_cast<int>(i);
    }
    return -1;
}

}  // namespace sim
