// The comparison as text for people and as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/compare/comparison.h"

namespace sim {

/// Two tables in Markdown: the methods at each error, and what they meet.
std::string table_of(const Comparison& comparison);

/// {"rows": […], "requirements": […], "width", "height", "cell_m"}. What has not been measured is null.
nlohmann::json json_of(const Comparison& comparison);

}  // namespace sim
