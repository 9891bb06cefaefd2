// The building tags of an OGR feature, from columns of their own or from OSM's `other_tags` column.
#pragma once

#include <ogr_api.h>

#include <string>
#include <string_view>
#include <vector>

#include "data/building_height.h"

namespace data {

/// The value of `key` in text of the form "key"=>"value","key"=>"value" (backslash escapes), or empty.
/// Cost: O(length).
std::string hstore_value(std::string_view text, std::string_view key);

/// Where a layer keeps its tags. Columns are found whatever their case, `_` standing for `:` too.
class FeatureTags {
  public:
    explicit FeatureTags(OGRFeatureDefnH layer);

    /// The layer says what a building is: only features with a value other than `no` are.
    bool has_building_column() const { return building_ >= 0; }
    bool is_building(OGRFeatureH feature) const;
    BuildingTags read(OGRFeatureH feature) const;

    /// osm_id, osm_way_id, id or fid of the source, else `otherwise`.
    int64_t id(OGRFeatureH feature, int64_t otherwise) const;

  private:
    std::string value(OGRFeatureH feature, const std::vector<int>& columns, std::string_view key) const;

    int building_ = -1, other_tags_ = -1;
    std::vector<int> height_, levels_, min_height_, min_level_, id_;  ///< columns, most trusted first
};

}  // namespace data
