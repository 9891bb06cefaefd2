#include "data/motion_gpx.h"

#include <ogr_api.h>

#include <chrono>

#include "data/gdal_border.h"

namespace data {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct FeatureDestroyer {
    void operator()(void* feature) const { OGR_F_Destroy(static_cast<OGRFeatureH>(feature)); }
};
using FeaturePtr = std::unique_ptr<void, FeatureDestroyer>;

/// Seconds since 1970 UTC; NaN where the point has no time.
double time_of(OGRFeatureH point, int field) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, zone = 0;
    float second = 0.0f;
    if (field < 0 || !OGR_F_IsFieldSetAndNotNull(point, field)) return kNan;
    if (!OGR_F_GetFieldAsDateTimeEx(point, field, &year, &month, &day, &hour, &minute, &second, &zone))
        return kNan;
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) return kNan;
    const double days = static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
    const double quarter_hours = zone > 1 ? zone - 100 : 0;  // OGR: 100 is UTC, 101 a quarter of an hour east
    // OGR keeps milliseconds; its float seconds carry some noise below them.
    const double second_ms = static_cast<double>(static_cast<int>(second * 1000.0f + 0.5f));
    return days * 86'400.0 + hour * 3600.0 + minute * 60.0 + second_ms * 1e-3 - quarter_hours * 900.0;
}

MotionFix fix_of(OGRFeatureH point, int time_field, int height_field) {
    MotionFix fix;
    fix.time_s = time_of(point, time_field);
    OGRGeometryH place = OGR_F_GetGeometryRef(point);
    fix.site.x = place == nullptr ? kNan : OGR_G_GetX(place, 0);
    fix.site.y = place == nullptr ? kNan : OGR_G_GetY(place, 0);
    const bool has_height = height_field >= 0 && OGR_F_IsFieldSetAndNotNull(point, height_field);
    fix.site.height_m = has_height ? OGR_F_GetFieldAsDouble(point, height_field) : kNan;
    return fix;
}

}  // namespace

lod::Result<MotionFixes> read_motion_gpx(const std::string& path) {
    static constexpr const char* kDrivers[] = {"GPX", nullptr};
    const GdalMessages messages;
    const DatasetPtr source(GDALOpenEx(
        path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kDrivers, nullptr, nullptr));
    if (!source)
        return lod::Error{path + ": cannot read GPX: " + messages.text("not a GPX file") +
                          "; expected a whole GPX track"};
    OGRLayerH points = GDALDatasetGetLayerByName(source.get(), "track_points");
    if (points == nullptr) return lod::Error{path + ": no track points; expected a GPX track"};
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(points);
    const int time_field = OGR_FD_GetFieldIndex(fields, "time"),
              height_field = OGR_FD_GetFieldIndex(fields, "ele");
    MotionFixes out;
    OGR_L_ResetReading(points);
    while (const FeaturePtr point{OGR_L_GetNextFeature(points)})
        out.add(fix_of(static_cast<OGRFeatureH>(point.get()), time_field, height_field));
    if (messages.has_failed())
        return lod::Error{path + ": cannot read all of the track: " + messages.text("") +
                          "; expected a whole file"};
    return out;
}

}  // namespace data
