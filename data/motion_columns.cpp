#include "data/motion_columns.h"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <span>

namespace data {

namespace {

constexpr double kFoot_m = 0.3048, kDegree_rad = std::numbers::pi / 180.0;

struct KnownName {
    std::string_view name;
    MotionRole role;
};

/// In order of preference within a role. `AltMSL`, `AltB`, `AltGPS`, `HDG`, `Lcl Date` ..: Garmin's logs.
constexpr std::array kNames{
    KnownName{"time", MotionRole::kTime},
    KnownName{"timestamp", MotionRole::kTime},
    KnownName{"time_utc", MotionRole::kTime},
    KnownName{"utc", MotionRole::kTime},
    KnownName{"datetime", MotionRole::kTime},
    KnownName{"epoch", MotionRole::kTime},
    KnownName{"lcl time", MotionRole::kTime},
    KnownName{"t", MotionRole::kTime},
    KnownName{"date", MotionRole::kDate},
    KnownName{"lcl date", MotionRole::kDate},
    KnownName{"utcofst", MotionRole::kZone},
    KnownName{"longitude", MotionRole::kLongitude},
    KnownName{"lon", MotionRole::kLongitude},
    KnownName{"lng", MotionRole::kLongitude},
    KnownName{"latitude", MotionRole::kLatitude},
    KnownName{"lat", MotionRole::kLatitude},
    KnownName{"x", MotionRole::kX},
    KnownName{"easting", MotionRole::kX},
    KnownName{"y", MotionRole::kY},
    KnownName{"northing", MotionRole::kY},
    KnownName{"height", MotionRole::kHeight},
    KnownName{"altmsl", MotionRole::kHeight},
    KnownName{"altitude", MotionRole::kHeight},
    KnownName{"alt", MotionRole::kHeight},
    KnownName{"elevation", MotionRole::kHeight},
    KnownName{"ele", MotionRole::kHeight},
    KnownName{"geoaltitude", MotionRole::kHeight},
    KnownName{"baroaltitude", MotionRole::kHeight},
    KnownName{"altb", MotionRole::kHeight},
    KnownName{"altgps", MotionRole::kHeight},
    KnownName{"z", MotionRole::kHeight},
    KnownName{"heading", MotionRole::kHeading},
    KnownName{"hdg", MotionRole::kHeading},
    KnownName{"yaw", MotionRole::kHeading},
    KnownName{"pitch", MotionRole::kPitch},
    KnownName{"roll", MotionRole::kRoll},
    KnownName{"bank", MotionRole::kRoll},
    KnownName{"magvar", MotionRole::kMagneticVariation},
};

struct KnownUnit {
    std::string_view name;
    double si_per_unit;
};
constexpr std::array kUnits{
    KnownUnit{"m", 1.0},      KnownUnit{"ft", kFoot_m},      KnownUnit{"s", 1.0},
    KnownUnit{"ms", 1e-3},    KnownUnit{"deg", kDegree_rad}, KnownUnit{"degrees", kDegree_rad},
    KnownUnit{"rad", 1.0},    KnownUnit{"feet", kFoot_m},    KnownUnit{"metres", 1.0},
    KnownUnit{"meters", 1.0}, KnownUnit{"km", 1000.0},
};

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& letter : result)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return result;
}

std::optional<double> unit_named(std::string_view name) {
    const std::string first = lower(name.substr(0, name.find(' ')));  // `ft msl`, `deg true`
    for (const KnownUnit& unit : kUnits) {
        if (unit.name == first) return unit.si_per_unit;
    }
    return std::nullopt;
}

/// A header cell taken apart: `Altitude (ft)`, `altitude[ft]`, `altitude_ft`.
struct ColumnName {
    std::string base;
    std::optional<double> si_per_unit;
};

ColumnName take_apart(std::string_view cell) {
    const std::string name = lower(cell);
    const size_t open = name.find_first_of("([");
    if (open != std::string::npos) {
        const size_t base_end = name.find_last_not_of(" _", open == 0 ? 0 : open - 1);
        const size_t close = std::min(name.find_first_of(")]", open), name.size());
        return {name.substr(0, base_end + 1),
                unit_named(std::string_view(name).substr(open + 1, close - open - 1))};
    }
    const size_t mark = name.rfind('_');
    if (mark != std::string::npos) {
        if (const std::optional<double> unit = unit_named(std::string_view(name).substr(mark + 1)))
            return {name.substr(0, mark), unit};
    }
    return {name, std::nullopt};
}

bool is_angle(MotionRole role) {
    return role == MotionRole::kHeading || role == MotionRole::kPitch || role == MotionRole::kRoll ||
           role == MotionRole::kMagneticVariation;
}

/// Longitude and latitude stay degrees.
bool is_site_angle(MotionRole role) {
    return role == MotionRole::kLongitude || role == MotionRole::kLatitude;
}

double usual_unit(MotionRole role, const std::string& base, bool is_state_vector) {
    if (is_angle(role) || is_site_angle(role)) return kDegree_rad;
    const bool in_feet = is_state_vector && (base == "altitude" || base == "geoaltitude");
    return in_feet ? kFoot_m : 1.0;
}

std::optional<MotionColumn> find_role(MotionRole role, std::span<const ColumnName> columns,
                                      const std::vector<std::string>& units) {
    const bool is_state_vector = std::any_of(columns.begin(), columns.end(), [](const ColumnName& column) {
        return column.base == "groundspeed" && !column.si_per_unit;
    });
    for (const KnownName& known : kNames) {
        if (known.role != role) continue;
        for (size_t i = 0; i < columns.size(); ++i) {
            if (columns[i].base != known.name) continue;
            std::optional<double> unit = columns[i].si_per_unit;
            if (!unit && i < units.size()) unit = unit_named(units[i]);
            MotionColumn found{i, unit.value_or(usual_unit(role, columns[i].base, is_state_vector))};
            if (is_site_angle(role)) found.si_per_unit /= kDegree_rad;
            return found;
        }
    }
    return std::nullopt;
}

}  // namespace

lod::Result<MotionColumns> MotionColumns::find(const std::vector<std::string>& names,
                                               const std::vector<std::string>& units) {
    std::vector<ColumnName> apart;
    for (const std::string& name : names)
        apart.push_back(take_apart(name));
    MotionColumns columns;
    for (size_t role = 0; role < columns.columns_.size(); ++role)
        columns.columns_[role] = find_role(static_cast<MotionRole>(role), apart, units);

    if (!columns[MotionRole::kTime]) return lod::Error{"no column for the time; expected one named time"};
    const bool has_degrees = columns[MotionRole::kLongitude] && columns[MotionRole::kLatitude];
    const bool has_plane = columns[MotionRole::kX] && columns[MotionRole::kY];
    if (!has_degrees && !has_plane)
        return lod::Error{"no columns for the place; expected lon and lat, or x and y"};
    if (!has_degrees) columns.columns_[static_cast<size_t>(MotionRole::kLongitude)].reset();
    if (!columns[MotionRole::kHeight])
        return lod::Error{"no column for the height; expected one named height"};
    return columns;
}

}  // namespace data
