#include "data/time_text.h"

#include <charconv>
#include <chrono>
#include <cstddef>

namespace data {

namespace {

constexpr double kDay_s = 86'400.0;

/// A text that is read from its front.
struct Scanner {
    std::string_view rest;

    bool take(char letter) {
        if (rest.empty() || rest.front() != letter) return false;
        rest.remove_prefix(1);
        return true;
    }

    /// Exactly `digits` digits; -1 when they are not there.
    int take_digits(size_t digits) {
        int number = 0;
        const char* end = rest.data() + digits;
        if (rest.size() < digits || rest.front() == '-') return -1;
        const auto [stop, error] = std::from_chars(rest.data(), end, number);
        if (error != std::errc() || stop != end) return -1;
        rest.remove_prefix(digits);
        return number;
    }

    /// Digits with an optional fraction; -1 when they are not there.
    double take_seconds() {
        double number = 0.0;
        if (rest.empty() || rest.front() < '0' || rest.front() > '9') return -1.0;
        const auto [stop, error] =
            std::from_chars(rest.data(), rest.data() + rest.size(), number, std::chars_format::fixed);
        if (error != std::errc()) return -1.0;
        rest.remove_prefix(static_cast<size_t>(stop - rest.data()));
        return number;
    }
};

std::optional<double> take_date_s(Scanner& scanner) {
    const int year = scanner.take_digits(4);
    if (!scanner.take('-')) return std::nullopt;
    const int month = scanner.take_digits(2);
    if (!scanner.take('-')) return std::nullopt;
    const int day = scanner.take_digits(2);
    if (year < 0 || month < 0 || day < 0) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) return std::nullopt;
    return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count()) * kDay_s;
}

std::optional<double> take_clock_s(Scanner& scanner) {
    const int hours = scanner.take_digits(2);
    if (!scanner.take(':')) return std::nullopt;
    const int minutes = scanner.take_digits(2);
    const double seconds = scanner.take(':') ? scanner.take_seconds() : 0.0;
    if (hours < 0 || hours > 24 || minutes < 0 || minutes > 59 || seconds < 0.0 || seconds >= 61.0)
        return std::nullopt;
    return hours * 3600.0 + minutes * 60.0 + seconds;
}

/// `Z`, nothing, `+01:00`, `+0100`, `+01`: seconds to subtract for UTC.
std::optional<double> take_zone_s(Scanner& scanner) {
    if (scanner.rest.empty() || scanner.take('Z') || scanner.take('z')) return 0.0;
    const double sign = scanner.rest.front() == '-' ? -1.0 : 1.0;
    if (!scanner.take('+') && !scanner.take('-')) return std::nullopt;
    const int hours = scanner.take_digits(2);
    scanner.take(':');
    const int minutes = scanner.rest.empty() ? 0 : scanner.take_digits(2);
    if (hours < 0 || minutes < 0) return std::nullopt;
    return sign * (hours * 3600.0 + minutes * 60.0);
}

}  // namespace

std::optional<double> parse_iso_time(std::string_view text) {
    Scanner scanner{text};
    const std::optional<double> date_s = take_date_s(scanner);
    if (!date_s || scanner.rest.empty()) return date_s;
    if (!scanner.take('T') && !scanner.take(' ')) return std::nullopt;
    const std::optional<double> clock_s = take_clock_s(scanner);
    const std::optional<double> zone_s = take_zone_s(scanner);
    if (!clock_s || !zone_s || !scanner.rest.empty()) return std::nullopt;
    return *date_s + *clock_s - *zone_s;
}

std::optional<double> parse_clock(std::string_view text) {
    Scanner scanner{text};
    const double sign = !text.empty() && text.front() == '-' ? -1.0 : 1.0;
    if (!scanner.take('+')) scanner.take('-');
    const std::optional<double> clock_s = take_clock_s(scanner);
    scanner.take('Z');
    if (!clock_s || !scanner.rest.empty()) return std::nullopt;
    return sign * *clock_s;
}

}  // namespace data
