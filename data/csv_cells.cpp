#include "data/csv_cells.h"

#include <algorithm>
#include <charconv>

namespace data {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const size_t begin = text.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string_view take_line(std::string_view& content) {
    const size_t end = std::min(content.find('\n'), content.size());
    const std::string_view line = content.substr(0, end);
    content.remove_prefix(std::min(end + 1, content.size()));
    return line;
}

std::vector<std::string> split(std::string_view line, char separator) {
    std::vector<std::string> cells(1);
    bool is_quoted = false, was_quote = false;
    for (const char letter : line) {
        if (letter == '"') {
            if (was_quote && !is_quoted) cells.back() += '"';  // doubled
            is_quoted = !is_quoted;
            was_quote = true;
            continue;
        }
        was_quote = false;
        if (letter == separator && !is_quoted) {
            cells.emplace_back();
        } else {
            cells.back() += letter;
        }
    }
    for (std::string& cell : cells)
        cell = std::string(trimmed(cell));
    return cells;
}

char separator_of(std::string_view header) {
    char best = ',';
    for (const char candidate : {';', '\t'}) {
        if (std::count(header.begin(), header.end(), candidate) >
            std::count(header.begin(), header.end(), best))
            best = candidate;
    }
    return best;
}

std::optional<double> number_of(std::string_view text) {
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double number = 0.0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace data
