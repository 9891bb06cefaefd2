#include "sim/toml_table.h"

#include <fmt/format.h>

#include <cmath>

namespace sim {

void TomlProblem::note(const toml::value& at, const std::string& what) {
    if (message.empty()) message = fmt::format("{}:{}: {}", file, at.location().line(), what);
}

TomlTable::TomlTable(const toml::value& table, std::string name, TomlProblem& problem)
    : table_(table), name_(std::move(name)), problem_(problem) {
    if (!table_.is_table()) problem_.note(table_, name_ + " is not a table, expected one");
}

const toml::value* TomlTable::find(const std::string& key) const {
    if (!table_.is_table()) return nullptr;
    const auto& entries = table_.as_table(std::nothrow);
    const auto found = entries.find(key);
    return found == entries.end() ? nullptr : &found->second;
}

const toml::value* TomlTable::take_value(const std::string& key) {
    taken_.insert(key);
    return find(key);
}

void TomlTable::take(const std::string& key, std::string& out) {
    const toml::value* value = take_value(key);
    if (!value) return;
    if (!value->is_string() || value->as_string(std::nothrow).str.empty()) {
        problem_.note(*value, fmt::format("{} {} is not a name, expected a string", name_, key));
        return;
    }
    out = value->as_string(std::nothrow).str;
}

void TomlTable::take(const std::string& key, std::vector<std::string>& out) {
    const toml::value* value = take_value(key);
    if (!value) return;
    const std::string expected =
        fmt::format("{} {} is not a list of names, expected strings in brackets", name_, key);
    if (!value->is_array() || value->as_array(std::nothrow).empty()) return problem_.note(*value, expected);
    out.clear();
    for (const toml::value& item : value->as_array(std::nothrow)) {
        if (!item.is_string() || item.as_string(std::nothrow).str.empty())
            return problem_.note(item, expected);
        out.push_back(item.as_string(std::nothrow).str);
    }
}

bool TomlTable::read_number(const toml::value& value, const std::string& what, double& out) {
    double number = NAN;
    if (value.is_floating()) number = value.as_floating(std::nothrow);
    if (value.is_integer()) number = static_cast<double>(value.as_integer(std::nothrow));
    if (!std::isfinite(number)) {
        problem_.note(value, what + " is not a number, expected a finite one");
        return false;
    }
    out = number;
    return true;
}

void TomlTable::take(const std::string& key, double& out, NumberRange range) {
    const toml::value* value = take_value(key);
    double number = 0.0;
    if (!value || !read_number(*value, name_ + " " + key, number)) return;
    if (number < range.min || number > range.max) {
        const std::string expected = range.max >= 1e300    ? fmt::format("at least {}", range.min)
                                     : range.min <= -1e300 ? fmt::format("at most {}", range.max)
                                                           : fmt::format("{} to {}", range.min, range.max);
        problem_.note(*value, fmt::format("{} {} is {}, expected {}", name_, key, number, expected));
        return;
    }
    out = number;
}

bool TomlTable::read_numbers(const toml::value& value, const std::string& what, std::vector<double>& out) {
    if (!value.is_array()) {
        problem_.note(value, what + " is not a list, expected numbers in brackets");
        return false;
    }
    for (const toml::value& item : value.as_array(std::nothrow)) {
        double number = 0.0;
        if (!read_number(item, "an entry of " + what, number)) return false;
        out.push_back(number);
    }
    return true;
}

namespace {

std::string count_text(size_t least, size_t most) {
    return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

}  // namespace

void TomlTable::take(const std::string& key, std::vector<double>& out, size_t least, size_t most) {
    const toml::value* value = take_value(key);
    std::vector<double> numbers;
    if (!value || !read_numbers(*value, name_ + " " + key, numbers)) return;
    if (numbers.size() < least || numbers.size() > most) {
        problem_.note(*value, fmt::format("{} {} has {} numbers, expected {}", name_, key, numbers.size(),
                                          count_text(least, most)));
        return;
    }
    out = std::move(numbers);
}

void TomlTable::take(const std::string& key, std::vector<std::vector<double>>& out, size_t least,
                     size_t most) {
    const toml::value* value = take_value(key);
    if (!value) return;
    const std::string what = name_ + " " + key;
    if (!value->is_array()) return problem_.note(*value, what + " is not a list, expected lists of numbers");
    out.clear();
    for (const toml::value& item : value->as_array(std::nothrow)) {
        std::vector<double> numbers;
        if (!read_numbers(item, "an entry of " + what, numbers)) return;
        if (numbers.size() < least || numbers.size() > most) {
            return problem_.note(item, fmt::format("an entry of {} has {} numbers, expected {}", what,
                                                   numbers.size(), count_text(least, most)));
        }
        out.push_back(std::move(numbers));
    }
}

void TomlTable::take_word(const std::string& key, const std::vector<std::string>& words, size_t& index) {
    const toml::value* value = take_value(key);
    if (!value) return;
    std::string expected;
    for (size_t i = 0; i < words.size(); ++i) {
        if (value->is_string() && value->as_string(std::nothrow).str == words[i]) {
            index = i;
            return;
        }
        expected += (i ? " or \"" : "\"") + words[i] + "\"";
    }
    problem_.note(*value, fmt::format("{} {} is not known, expected {}", name_, key, expected));
}

const toml::value* TomlTable::take_table(const std::string& key) {
    const toml::value* value = take_value(key);
    if (value && !value->is_table()) {
        problem_.note(*value, fmt::format("{} is not a table, expected [{}]", key, key));
        return nullptr;
    }
    return value;
}

std::vector<const toml::value*> TomlTable::take_tables(const std::string& key) {
    std::vector<const toml::value*> tables;
    const toml::value* value = take_value(key);
    if (!value) return tables;
    if (!value->is_array()) {
        problem_.note(*value, fmt::format("{} is not a list of tables, expected [[{}]]", key, key));
        return tables;
    }
    for (const toml::value& item : value->as_array(std::nothrow))
        tables.push_back(&item);
    return tables;
}

void TomlTable::require(const std::string& key) {
    if (!has(key)) problem_.note(table_, fmt::format("{} has no {}, expected one", name_, key));
}

void TomlTable::reject(const std::string& key, const std::string& what) {
    const toml::value* value = find(key);
    problem_.note(value ? *value : table_, fmt::format("{} {} {}", name_, key, what));
}

void TomlTable::finish() {
    if (!table_.is_table()) return;
    const toml::value* first = nullptr;
    std::string first_key;
    for (const auto& [key, value] : table_.as_table(std::nothrow)) {
        if (taken_.count(key)) continue;
        const bool is_earlier = !first || value.location().line() < first->location().line() ||
                                (value.location().line() == first->location().line() && key < first_key);
        if (is_earlier) {
            first = &value;
            first_key = key;
        }
    }
    if (!first) return;
    std::string known;
    for (const std::string& key : taken_)
        known += (known.empty() ? "" : ", ") + key;
    problem_.note(
        *first, fmt::format("{} does not know the key \"{}\", expected one of: {}", name_, first_key, known));
}

std::vector<std::pair<std::string, std::string>> TomlTable::take_all_strings() {
    std::vector<std::pair<std::string, std::string>> all;
    if (!table_.is_table()) return all;
    for (const auto& [key, value] : table_.as_table(std::nothrow)) {
        std::string text;
        take(key, text);
        all.emplace_back(key, text);
    }
    std::sort(all.begin(), all.end());  // the library's table has no order
    return all;
}

}  // namespace sim
