#include "sim/command_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <thread>

#include "terrain/batched_errors.h"

namespace sim {
namespace {

template <typename Number>
bool parse_whole(std::string_view text, Number& out) {
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, out);
    return problem == std::errc() && stop == end && !text.empty();
}

}  // namespace

bool parse_size(const std::string& text, Size& out) {
    const size_t cross = text.find_first_of("xX");
    if (cross == std::string::npos) return false;
    Size size;
    const std::string_view view(text);
    if (!parse_whole(view.substr(0, cross), size.width_px) ||
        !parse_whole(view.substr(cross + 1), size.height_px)) {
        return false;
    }
    const auto is_good = [](int side) { return side >= 1 && side <= 16384; };
    if (!is_good(size.width_px) || !is_good(size.height_px)) return false;
    out = size;
    return true;
}

bool parse_numbers(const std::string& text, size_t count, std::vector<double>& out) {
    std::vector<double> numbers;
    std::string_view rest(text);
    while (true) {
        const size_t comma = rest.find(',');
        double number = 0.0;
        if (!parse_whole(rest.substr(0, comma), number) || !std::isfinite(number)) return false;
        numbers.push_back(number);
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (numbers.size() != count) return false;
    out = std::move(numbers);
    return true;
}

CLI::Option* add_size(CLI::App& app, Size& out) {
    const auto check = [](const std::string& text) {
        Size size;
        return parse_size(text, size) ? std::string() : "expected WIDTHxHEIGHT in pixels, as 640x360";
    };
    return app
        .add_option_function<std::string>(
            "--size", [&out](const std::string& text) { parse_size(text, out); }, "picture, pixels")
        ->check(check, "")
        ->type_name("WxH")
        ->default_str(fmt::format("{}x{}", out.width_px, out.height_px));
}

CLI::Option* add_numbers(CLI::App& app, const std::string& name, std::vector<double>& out, size_t count,
                         const std::string& description) {
    const auto check = [count](const std::string& text) {
        std::vector<double> numbers;
        return parse_numbers(text, count, numbers)
                   ? std::string()
                   : fmt::format("expected {} numbers with commas between", count);
    };
    const auto read = [&out, count](const std::string& text) { parse_numbers(text, count, out); };
    return app.add_option_function<std::string>(name, read, description)->check(check, "");
}

CLI::Option* add_batch(CLI::App& app, int& out) {
    return app
        .add_option(
            "--batch", out,
            "each leaf of the terrain's mesh is drawn as 4^K triangles; above 0 vertices do not glide, and "
            "the terrain is no store")
        ->check(CLI::Range(0, terrain::kMostBatch))
        ->type_name("K")
        ->capture_default_str();
}

CLI::Option* add_threads(CLI::App& app, unsigned& out) {
    out = std::clamp(std::thread::hardware_concurrency(), 1u, 64u);
    return app.add_option("--threads", out, "threads that prepare the terrain; no result depends on them")
        ->check(CLI::Range(1u, 64u))
        ->type_name("N")
        ->capture_default_str();
}

}  // namespace sim
