#include "data/schedule_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

#include "data/csv_cells.h"
#include "data/file_bytes.h"

namespace data {

namespace {

constexpr size_t kMaxBytes = size_t{4} << 30;
constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

enum Column { kId, kAppears, kDisappears, kTime, kX, kY, kZ, kQx, kQy, kQz, kQw, kHeading, kModel, kColumns };
constexpr std::array<std::string_view, kColumns> kNames = {
    "id", "appears_s", "disappears_s", "time_s", "x_m",         "y_m",  "z_m",
    "qx", "qy",        "qz",           "qw",     "heading_deg", "model"};
using Places = std::array<std::optional<size_t>, kColumns>;  ///< where each column is

/// One row: its cells by column, and where it stands, for messages.
struct Row {
    const std::vector<std::string>& cells;
    const Places& places;
    std::string where;

    std::string_view text(Column column) const {
        return places[column] && *places[column] < cells.size() ? std::string_view(cells[*places[column]])
                                                                : std::string_view();
    }
    lod::Error bad(Column column, const std::string& what) const {
        return {where + ": " + std::string(kNames[column]) + " " + what};
    }
};

/// Reads numbers of a row and remembers the first that is none.
struct NumberReader {
    const Row& row;
    std::string problem;

    std::optional<double> operator()(Column column) {
        const std::string_view text = row.text(column);
        if (text.empty()) return std::nullopt;
        const std::optional<double> number = number_of(text);
        if (number && std::isfinite(*number)) return number;
        if (problem.empty())
            problem = row.bad(column, "is '" + std::string(text) + "', expected a number").message;
        return std::nullopt;
    }
};

lod::Result<Places> find_columns(const std::vector<std::string>& header, const std::string& where) {
    Places places;
    for (size_t i = 0; i < header.size(); ++i) {
        const auto name = std::find(kNames.begin(), kNames.end(), header[i]);
        if (name == kNames.end())
            return lod::Error{where + ": column '" + header[i] +
                              "' is unknown, expected id, appears_s, disappears_s, time_s, "
                              "x_m, y_m, z_m, qx, qy, qz, qw, heading_deg or model"};
        places[static_cast<size_t>(name - kNames.begin())] = i;
    }
    if (!places[kId])
        return lod::Error{where + ": no column id, expected a first line that names the columns"};
    return places;
}

/// The key frame of a row that has a time.
lod::Result<KeyFrame> read_key(double time_s, const Row& row, NumberReader& number) {
    KeyFrame key;
    key.time_s = time_s;
    for (int axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<Column>(kX + axis);
        const std::optional<double> value = number(column);
        if (!value) return row.bad(column, "is missing, expected a place for the key frame");
        key.position[axis] = *value;
    }
    const std::array<std::optional<double>, 4> q = {number(kQx), number(kQy), number(kQz), number(kQw)};
    const auto given = std::count_if(q.begin(), q.end(), [](const auto& part) { return part.has_value(); });
    if (given == 4) key.rotation = glm::dquat(*q[3], *q[0], *q[1], *q[2]);
    if (given != 0 && given != 4)
        return row.bad(kQx, "to qw are not all there, expected a whole quaternion or none");
    if (const auto heading_deg = number(kHeading)) {
        const double half_rad = -*heading_deg * kRadPerDeg / 2.0 + kRadPerDeg * 90.0;  // mesh -y looks ahead
        if (given == 0) key.rotation = glm::dquat(std::cos(half_rad), 0.0, 0.0, std::sin(half_rad));
    }
    return key;
}

lod::Result<lod::Ok> read_row(const Row& row, int line, Schedule& out) {
    NumberReader number{row, {}};
    const auto appears_s = number(kAppears), disappears_s = number(kDisappears), time_s = number(kTime);
    const std::string id(row.text(kId));
    if (id.empty()) {
        if (!number.problem.empty()) return lod::Error{number.problem};
        if (!disappears_s || !(*disappears_s > 0.0))
            return row.bad(kId,
                           "is empty and disappears_s no time after 0 s, expected an id, or the scene's end");
        out.end_s = *disappears_s;
        return lod::Ok{};
    }
    ScheduleEntry& entry = out.entries[id];
    if (entry.line == 0) entry.line = line;
    if (appears_s) entry.events.push_back({*appears_s, true});
    if (disappears_s) entry.events.push_back({*disappears_s, false});
    if (time_s) {
        const auto key = read_key(*time_s, row, number);
        if (!number.problem.empty()) return lod::Error{number.problem};
        if (!key) return key.error();
        entry.keys.push_back(*key);
    }
    if (!row.text(kModel).empty()) entry.model = row.text(kModel);
    return number.problem.empty() ? lod::Result<lod::Ok>(lod::Ok{}) : lod::Error{number.problem};
}

}  // namespace

lod::Result<Schedule> read_schedule(const std::string& path) {
    const auto bytes = read_file(path, kMaxBytes);
    if (!bytes) return bytes.error();
    std::string_view content(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (!content.empty() && content.back() != '\n')
        return lod::Error{path + ": the last line has no end, expected a file that is not cut short"};
    Schedule schedule;
    std::optional<Places> places;
    char separator = ',';
    for (int line = 1; !content.empty(); ++line) {
        const std::string_view text = trimmed(take_line(content));
        if (text.empty() || text.front() == '#') continue;
        const std::string where = path + ":" + std::to_string(line);
        if (!places) {
            separator = separator_of(text);
            const auto found = find_columns(split(text, separator), where);
            if (!found) return found.error();
            places = *found;
            continue;
        }
        const std::vector<std::string> cells = split(text, separator);
        if (const auto read = read_row({cells, *places, where}, line, schedule); !read) return read.error();
    }
    if (!places) return lod::Error{path + ": empty, expected a first line that names the columns"};
    return schedule;
}

double end_of(const Schedule& schedule) {
    if (schedule.end_s > 0.0) return schedule.end_s;
    double end_s = 0.0;
    for (const auto& [id, entry] : schedule.entries) {
        for (const VisibilityStep& event : entry.events)
            end_s = std::max(end_s, event.time_s);
        for (const KeyFrame& key : entry.keys)
            end_s = std::max(end_s, key.time_s);
    }
    return end_s > 0.0 ? end_s : 1.0;
}

namespace {

void append_number(double value, std::string& csv) {
    char text[32];
    csv.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string id_cell(const std::string& id) {
    std::string plain = id;
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    if (plain.find_first_of(",;\"#") == std::string::npos && trimmed(plain) == plain) return plain;
    std::string quoted = "\"";
    for (char c : plain)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

/// Whether a GLB node holds the pose to the last bit.
bool is_plain(const KeyFrame& key) {
    const glm::dvec3& p = key.position;
    return key.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0) && glm::dvec3(glm::vec3(p)) == p;
}

/// A row a span: from one step that shows to the next that hides.
void append_events(const std::string& id, std::span<const VisibilityStep> steps, std::string& csv) {
    for (size_t i = 0; i < steps.size();) {
        csv += id + ",";
        if (steps[i].is_visible) append_number(steps[i++].time_s, csv);
        csv += ",";
        if (i < steps.size() && !steps[i].is_visible) append_number(steps[i++].time_s, csv);
        csv += "\n";
    }
}

}  // namespace

std::string schedule_csv(const TimedScene& scene) {
    std::string csv = "id,appears_s,disappears_s,time_s,x_m,y_m,z_m,qx,qy,qz,qw\n,,";
    append_number(scene.end_s, csv);
    csv += "\n";
    for (const TimedObject& object : scene.objects) {
        const std::string id = id_cell(object.id);
        append_events(id, std::span(scene.steps).subspan(object.steps.begin, object.steps.size()), csv);
        const auto keys = std::span(scene.keys).subspan(object.keys.begin, object.keys.size());
        if (keys.size() == 1 && is_plain(keys[0])) continue;
        for (const KeyFrame& key : keys) {
            csv += id + ",,";
            for (const double value : {key.time_s, key.position.x, key.position.y, key.position.z,
                                       key.rotation.x, key.rotation.y, key.rotation.z, key.rotation.w}) {
                csv += ",";
                append_number(value, csv);
            }
            csv += "\n";
        }
    }
    return csv;
}

}  // namespace data
