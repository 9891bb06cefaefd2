// Points in time as recordings write them.
#pragma once

#include <optional>
#include <string_view>

namespace data {

/// Seconds since 1970-01-01 UTC of `2019-12-11T12:46:40.5+01:00` (a blank for the T, seconds, fraction and zone optional),
/// or of a date alone; empty for anything else. No leap seconds.
std::optional<double> parse_iso_time(std::string_view text);

/// Seconds of `12:46`, `12:46:40.5`; with a sign for offsets such as `+01:00`.
std::optional<double> parse_clock(std::string_view text);

}  // namespace data
