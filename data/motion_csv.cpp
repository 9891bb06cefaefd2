#include "data/motion_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "data/csv_cells.h"
#include "data/motion_columns.h"
#include "data/time_text.h"

namespace data {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDay_s = 86'400.0;
using Cells = std::vector<std::string>;

/// Rows to fixes; keeps what a row needs of the one before it.
class RowReader {
  public:
    RowReader(const MotionColumns& columns, MotionFixes& out) : columns_(columns), out_(out) {}

    void read(const Cells& row) {
        MotionFix fix;
        fix.time_s = time_s(row);
        const bool is_geographic = columns_.is_geographic();
        fix.site.x = value(row, is_geographic ? MotionRole::kLongitude : MotionRole::kX);
        fix.site.y = value(row, is_geographic ? MotionRole::kLatitude : MotionRole::kY);
        fix.site.height_m = value(row, MotionRole::kHeight);
        fix.heading_rad = value(row, MotionRole::kHeading);
        fix.pitch_rad = value(row, MotionRole::kPitch);
        fix.roll_rad = value(row, MotionRole::kRoll);
        const double variation_rad = value(row, MotionRole::kMagneticVariation);
        if (std::isfinite(variation_rad)) fix.heading_rad += variation_rad;
        out_.add(fix);
    }

  private:
    const std::string* cell(const Cells& row, MotionRole role) const {
        const std::optional<MotionColumn>& column = columns_[role];
        return column && column->index < row.size() ? &row[column->index] : nullptr;
    }

    /// SI (degrees for sites); NaN where the row has no number.
    double value(const Cells& row, MotionRole role) const {
        const std::string* text = cell(row, role);
        const std::optional<double> number = text == nullptr ? std::nullopt : number_of(*text);
        return number && std::isfinite(*number) ? *number * columns_[role]->si_per_unit : kNan;
    }

    double time_s(const Cells& row) {
        const std::string* text = cell(row, MotionRole::kTime);
        if (text == nullptr) return kNan;
        if (const std::optional<double> number = number_of(*text)) {
            const double scale = std::abs(*number) > 1e11 ? 1e-3 : 1.0;  // milliseconds since 1970
            return *number * columns_[MotionRole::kTime]->si_per_unit * scale;
        }
        if (const std::optional<double> moment_s = parse_iso_time(*text)) return *moment_s;
        const std::optional<double> clock_s = parse_clock(*text);
        if (!clock_s) return kNan;
        const std::string* date = cell(row, MotionRole::kDate);
        if (date == nullptr) return days_s(*clock_s);
        const std::string* zone = cell(row, MotionRole::kZone);
        const double zone_s = zone == nullptr ? 0.0 : parse_clock(*zone).value_or(0.0);
        const std::optional<double> day_s = parse_iso_time(*date);
        return day_s ? *day_s + *clock_s - zone_s : kNan;
    }

    /// Clock times without date: a fall of more than half a day is midnight.
    double days_s(double clock_s) {
        if (clock_s + midnights_s_ < last_s_ - 0.5 * kDay_s) midnights_s_ += kDay_s;
        last_s_ = clock_s + midnights_s_;
        return last_s_;
    }

    const MotionColumns& columns_;
    MotionFixes& out_;
    double midnights_s_ = 0.0, last_s_ = 0.0;
};

}  // namespace

lod::Result<MotionFixes> read_motion_csv(std::string_view content, const std::string& path) {
    if (content.substr(0, 3) == "\xef\xbb\xbf") content.remove_prefix(3);
    std::string_view header, above;
    size_t line_number = 0;
    while (!content.empty() && header.empty()) {
        const std::string_view line = trimmed(take_line(content));
        ++line_number;
        if (line.empty()) continue;
        (line.front() == '#' ? above : header) = line;
    }
    const std::string place = path + ":" + std::to_string(line_number);
    if (header.empty())
        return lod::Error{path + ": no header line; expected column names such as time,lon,lat,height"};
    const char separator = separator_of(header);
    Cells units;
    if (!above.empty()) units = split(above.substr(1), separator);
    const Cells names = split(header, separator);
    if (units.size() != names.size()) units.clear();
    const lod::Result<MotionColumns> columns = MotionColumns::find(names, units);
    if (!columns) return lod::Error{place + ": " + columns.message()};

    MotionFixes out;
    out.is_geographic = columns->is_geographic();
    RowReader reader(*columns, out);
    const bool has_last_end = content.empty() || content.back() == '\n' || content.back() == '\r';
    while (!content.empty()) {
        const std::string_view line = trimmed(take_line(content));
        if (line.empty() || line.front() == '#') continue;
        if (content.empty() && !has_last_end) {
            ++out.dropped;
            break;
        }
        reader.read(split(line, separator));
    }
    return out;
}

}  // namespace data
