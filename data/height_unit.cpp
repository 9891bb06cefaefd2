#include "data/height_unit.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "data/gdal_border.h"

namespace data {

namespace {

constexpr double kFoot_m = 0.3048, kUsSurveyFoot_m = 1200.0 / 3937.0;

struct NamedUnit {
    const char* name;
    double metres;
};
constexpr std::array<NamedUnit, 10> kExactNames = {{{"m", 1.0},
                                                    {"cm", 0.01},
                                                    {"dm", 0.1},
                                                    {"mm", 0.001},
                                                    {"km", 1000.0},
                                                    {"yd", 0.9144},
                                                    {"'", kFoot_m},
                                                    {"sft", kUsSurveyFoot_m},
                                                    {"centimetre", 0.01},
                                                    {"decimetre", 0.1}}};

}  // namespace

double metres_per_unit(const std::string& unit) {
    std::string name;
    for (char c : unit) {
        if (!std::isspace(static_cast<unsigned char>(c))) {
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    const auto* exact =
        std::find_if(kExactNames.begin(), kExactNames.end(), [&](auto& u) { return name == u.name; });
    if (exact != kExactNames.end()) return exact->metres;
    const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
    if (has("ft") || has("foot") || has("feet"))
        return has("us") || has("survey") ? kUsSurveyFoot_m : kFoot_m;
    if (name.starts_with("met")) return 1.0;
    return 0.0;
}

double metres_per_vertical_unit(const std::string& crs_wkt) {
    const GdalMessages quiet;
    OGRSpatialReference crs;
    if (crs_wkt.empty() || crs.SetFromUserInput(crs_wkt.c_str()) != OGRERR_NONE || !crs.IsCompound())
        return 1.0;
    const double metres = crs.GetTargetLinearUnits("COMPD_CS|VERT_CS", nullptr);
    return metres > 0.0 ? metres : 1.0;
}

}  // namespace data
