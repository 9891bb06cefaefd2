#include "sim/query_lines.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace sim {
namespace {

/// The numbers of a line; false when a word is none, or is not finite.
bool parse_line(std::string_view text, std::vector<double>& out) {
    constexpr std::string_view kBetween = " \t\r,";
    out.clear();
    text = text.substr(0, text.find('#'));
    while (true) {
        const size_t begin = text.find_first_not_of(kBetween);
        if (begin == std::string_view::npos) return true;
        text.remove_prefix(begin);
        const std::string_view word = text.substr(0, text.find_first_of(kBetween));
        double number = 0.0;
        const auto [stop, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (problem != std::errc() || stop != word.data() + word.size() || !std::isfinite(number))
            return false;
        out.push_back(number);
        text.remove_prefix(word.size());
    }
}

}  // namespace

lod::Result<lod::Ok> check_place(const data::WorldFrame& frame, const data::SitePoint& site,
                                 const std::string& where) {
    if (!frame.has_datum || (std::abs(site.x) <= 360.0 && std::abs(site.y) <= 90.0)) return lod::Ok{};
    return lod::Error{fmt::format("{}: {}, {} is no place, expected longitude and latitude in degrees", where,
                                  site.x, site.y)};
}

lod::Result<std::vector<QueryLine>> read_query_lines(std::istream& in, const std::string& name,
                                                     const data::WorldFrame& frame) {
    std::vector<QueryLine> lines;
    std::vector<double> n;
    std::string text;
    for (size_t number = 1; std::getline(in, text); ++number) {
        const bool is_read = parse_line(text, n);
        if (is_read && n.empty()) continue;
        const std::string where = fmt::format("{}:{}", name, number);
        if (!is_read || (n.size() != 2 && n.size() != 6)) {
            return lod::Error{fmt::format("{}: '{}', expected 2 numbers, x y, or 6, x y h x y h", where,
                                          text.substr(0, 60))};
        }
        QueryLine line;
        line.is_sight = n.size() == 6;
        line.from = {n[0], n[1], line.is_sight ? n[2] : 0.0};
        line.to = line.is_sight ? data::SitePoint{n[3], n[4], n[5]} : line.from;
        for (const data::SitePoint& site : {line.from, line.to}) {
            if (auto is_place = check_place(frame, site, where); !is_place) return is_place.error();
        }
        line.where = where;
        lines.push_back(std::move(line));
    }
    if (in.bad()) return lod::Error{name + ": cannot be read, expected lines of text"};
    return lines;
}

}  // namespace sim
