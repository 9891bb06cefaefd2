// Lines and cells of CSV text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace data {

/// The text without blanks, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The next line off the front of `content`.
std::string_view take_line(std::string_view& content);

/// The cells of a line, trimmed; a quoted one may hold the separator, and quotes that are doubled.
std::vector<std::string> split(std::string_view line, char separator);

/// Comma, semicolon or tab, whichever the line has most of.
char separator_of(std::string_view header);

/// A decimal number that is the whole text; NaN and infinities are numbers here.
std::optional<double> number_of(std::string_view text);

}  // namespace data
