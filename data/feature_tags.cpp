#include "data/feature_tags.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <initializer_list>
#include <optional>

namespace data {

namespace {

std::string plain_name(std::string_view name) {
    std::string plain(name);
    for (char& letter : plain) {
        letter = letter == ':' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return plain;
}

std::vector<int> find_columns(OGRFeatureDefnH layer, std::initializer_list<std::string_view> names) {
    std::vector<int> columns;
    for (const std::string_view name : names) {
        for (int i = 0; i < OGR_FD_GetFieldCount(layer); ++i) {
            if (plain_name(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(layer, i))) == name) columns.push_back(i);
        }
    }
    return columns;
}

int find_column(OGRFeatureDefnH layer, std::string_view name) {
    const std::vector<int> columns = find_columns(layer, {name});
    return columns.empty() ? -1 : columns.front();
}

std::string text_of(OGRFeatureH feature, int column) {
    if (column < 0 || !OGR_F_IsFieldSetAndNotNull(feature, column)) return {};
    return OGR_F_GetFieldAsString(feature, column);
}

/// Takes the next quoted string off the front of `text`.
std::optional<std::string> take_quoted(std::string_view& text) {
    size_t at = text.find('"');
    if (at == std::string_view::npos) return std::nullopt;
    std::string inside;
    for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\\' && at + 1 < text.size()) ++at;
        inside += text[at];
    }
    if (at >= text.size()) return std::nullopt;
    text.remove_prefix(at + 1);
    return inside;
}

}  // namespace

std::string hstore_value(std::string_view text, std::string_view key) {
    while (true) {
        const std::optional<std::string> name = take_quoted(text);
        const std::optional<std::string> value = take_quoted(text);
        if (!name || !value) return {};
        if (*name == key) return *value;
    }
}

FeatureTags::FeatureTags(OGRFeatureDefnH layer)
    : building_(find_column(layer, "building")),
      other_tags_(find_column(layer, "other_tags")),
      height_(find_columns(layer, {"height", "building_height"})),
      levels_(find_columns(layer, {"building_levels"})),
      min_height_(find_columns(layer, {"min_height"})),
      min_level_(find_columns(layer, {"building_min_level"})),
      id_(find_columns(layer, {"osm_id", "osm_way_id", "id", "ogc_fid", "fid"})) {}

bool FeatureTags::is_building(OGRFeatureH feature) const {
    if (!has_building_column()) return true;
    const std::string kind = text_of(feature, building_);
    return !kind.empty() && kind != "no";
}

std::string FeatureTags::value(OGRFeatureH feature, const std::vector<int>& columns,
                               std::string_view key) const {
    for (const int column : columns) {
        std::string text = text_of(feature, column);
        if (!text.empty()) return text;
    }
    if (other_tags_ < 0) return {};
    return hstore_value(text_of(feature, other_tags_), key);
}

BuildingTags FeatureTags::read(OGRFeatureH feature) const {
    BuildingTags tags;
    tags.height = value(feature, height_, "height");
    if (tags.height.empty()) tags.height = value(feature, {}, "building:height");
    tags.levels = value(feature, levels_, "building:levels");
    tags.min_height = value(feature, min_height_, "min_height");
    tags.min_level = value(feature, min_level_, "building:min_level");
    return tags;
}

int64_t FeatureTags::id(OGRFeatureH feature, int64_t otherwise) const {
    for (const int column : id_) {
        const std::string text = text_of(feature, column);
        int64_t id = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), id);
        if (!text.empty() && error == std::errc() && stop == text.data() + text.size()) return id;
    }
    return otherwise;
}

}  // namespace data
