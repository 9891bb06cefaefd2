#include "sim/compare/comparison_report.h"

#include <fmt/format.h>

#include "sim/compare/statistics.h"

namespace sim {
namespace {

using nlohmann::json;

std::string line_of(const CompareRow& row) {
    const Inspection& seen = row.inspection;
    const RaceTimes& times = row.times;
    return fmt::format(
        "| {} | {} | {:.2f} | {:.0f} | {:.0f} / {:.0f} | {:.0f} / {:.0f} | {:.0f} / {:.0f} | {:.1f} | {:.0f} "
        "| {:.0f} "
        "| {:.2f} | {:.2f} | {:.1f} + {:.1f} | {:.2f} |\n",
        row.method, row.target_px, row.calibration.measured_px, seen.triangles, percentile(times.cpu_us, 0.5),
        percentile(times.cpu_us, 0.99), percentile(times.turn_us, 0.5), percentile(times.turn_us, 0.99),
        percentile(times.teleport_us, 0.5), percentile(times.teleport_us, 0.99),
        percentile(times.frame_ms, 0.5), seen.commands, seen.upload_bytes / 1e3, 100.0 * seen.changed_share,
        seen.popping_px, row.memory_mb, row.pool_mb, row.prepare_s);
}

std::string line_of(const LeftOut& method, size_t columns) {
    std::string line = fmt::format("| {} | {} |", method.name, method.reason);
    for (size_t i = 2; i < columns; ++i)
        line += " |";
    return line + "\n";
}

std::string rule(size_t columns) {
    std::string line = "|";
    for (size_t i = 0; i < columns; ++i)
        line += "---|";
    return line + "\n";
}

std::string cell_of(const Requirement& requirement, const std::optional<double>& figure) {
    if (!figure) return "not measured";
    return fmt::format("{} ({:.4g})", is_met(requirement, *figure) ? "yes" : "no", *figure);
}

json json_of(const CompareRow& row) {
    const Inspection& seen = row.inspection;
    const RaceTimes& times = row.times;
    return {{"method", row.method},
            {"target_px", row.target_px},
            {"tolerance_px", row.calibration.tolerance_px},
            {"measured_px", row.calibration.measured_px},
            {"triangles", seen.triangles},
            {"cut_triangles", seen.cut_triangles},
            {"cpu_us_p50", percentile(times.cpu_us, 0.5)},
            {"cpu_us_p99", percentile(times.cpu_us, 0.99)},
            {"turn_us_p50", percentile(times.turn_us, 0.5)},
            {"turn_us_p99", percentile(times.turn_us, 0.99)},
            {"turn_operations_p50", percentile(times.turn_operations, 0.5)},
            {"teleport_us_p50", percentile(times.teleport_us, 0.5)},
            {"teleport_us_p99", percentile(times.teleport_us, 0.99)},
            {"frame_ms_p50", percentile(times.frame_ms, 0.5)},
            {"frame_ms_p99", percentile(times.frame_ms, 0.99)},
            {"commands", seen.commands},
            {"upload_bytes", seen.upload_bytes},
            {"changed_share", seen.changed_share},
            {"popping_px", seen.popping_px},
            {"popping_told_px", seen.told_px},
            {"acmr", seen.acmr},
            {"memory_mb", row.memory_mb},
            {"pool_mb", row.pool_mb},
            {"prepare_s", row.prepare_s}};
}

/// Every column of the contract, empty.
json json_of(const LeftOut& method, double target_px) {
    json row = {{"method", method.name}, {"target_px", target_px}, {"note", method.reason}};
    for (const char* column :
         {"measured_px", "triangles", "cpu_us_p50", "cpu_us_p99", "frame_ms_p50", "commands", "upload_bytes",
          "changed_share", "popping_px", "memory_mb", "prepare_s"}) {
        row[column] = nullptr;
    }
    return row;
}

json json_of(const RequirementRow& row) {
    json out = {{"method", row.method}};
    for (size_t i = 0; i < kRequirements.size(); ++i) {
        const Requirement& requirement = kRequirements[i];
        const std::optional<double>& figure = row.figures[i];
        json& cell = out[std::string(requirement.name)];
        if (figure) cell = {{"met", is_met(requirement, *figure)}, {"figure", *figure}};
    }
    return out;
}

}  // namespace

std::string table_of(const Comparison& comparison) {
    std::string text =
        "| method | target px | measured px | triangles | CPU us, flight p50 / p99 | 180° turn p50 / p99 "
        "| teleport p50 / p99 | frame ms p50 | commands | upload kB | changed % | popping px "
        "| memory + pool MB | prepare s |\n" +
        rule(14);
    for (const CompareRow& row : comparison.rows)
        text += line_of(row);
    for (const LeftOut& method : comparison.left_out)
        text += line_of(method, 14);
    text += "\n| method |";
    for (const Requirement& requirement : kRequirements)
        text += fmt::format(" {}: {} ≤ {} |", requirement.name, requirement.figure, requirement.limit);
    text += "\n" + rule(kRequirements.size() + 1);
    for (const RequirementRow& row : comparison.requirements) {
        text += fmt::format("| {} |", row.method);
        for (size_t i = 0; i < kRequirements.size(); ++i)
            text += fmt::format(" {} |", cell_of(kRequirements[i], row.figures[i]));
        text += "\n";
    }
    for (const LeftOut& method : comparison.left_out)
        text += line_of(method, kRequirements.size() + 1);
    return text;
}

json json_of(const Comparison& comparison) {
    json rows = json::array(), requirements = json::array();
    for (size_t i = 0; i < comparison.rows.size(); ++i) {
        const CompareRow& row = comparison.rows[i];
        rows.push_back(json_of(row));
        const bool is_last =
            i + 1 == comparison.rows.size() || comparison.rows[i + 1].target_px != row.target_px;
        if (!is_last) continue;
        for (const LeftOut& method : comparison.left_out)
            rows.push_back(json_of(method, row.target_px));
    }
    for (const RequirementRow& row : comparison.requirements)
        requirements.push_back(json_of(row));
    for (const LeftOut& method : comparison.left_out)
        requirements.push_back({{"method", method.name}, {"note", method.reason}});
    return {{"rows", std::move(rows)},
            {"requirements", std::move(requirements)},
            {"width", comparison.width},
            {"height", comparison.height},
            {"cell_m", comparison.cell_m}};
}

}  // namespace sim
