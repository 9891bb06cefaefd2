#include "data/streets.h"

#include <gdal.h>
#include <ogr_api.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "data/feature_tags.h"
#include "data/gdal_border.h"
#include "data/polygon_layer.h"

namespace data {

namespace {

struct FeatureDestroyer {
    void operator()(void* feature) const { OGR_F_Destroy(static_cast<OGRFeatureH>(feature)); }
};
using FeaturePtr = std::unique_ptr<void, FeatureDestroyer>;

struct Kind {
    std::string_view highway;
    double width_m;
};

/// Carriageways as commonly built; kinds that are not here are not for cars.
constexpr std::array kKinds{
    Kind{"motorway", 14.0},     Kind{"trunk", 12.0},        Kind{"primary", 11.0},
    Kind{"secondary", 10.0},    Kind{"tertiary", 8.5},      Kind{"unclassified", 7.0},
    Kind{"residential", 7.0},   Kind{"living_street", 6.0}, Kind{"motorway_link", 7.0},
    Kind{"trunk_link", 7.0},    Kind{"primary_link", 7.0},  Kind{"secondary_link", 6.5},
    Kind{"tertiary_link", 6.5}, Kind{"service", 4.5},
};

double width_of(std::string_view highway) {
    for (const Kind& kind : kKinds) {
        if (kind.highway == highway) return kind.width_m;
    }
    return 0.0;
}

/// A column's text or, failing that, the tag of this name in `other_tags`.
std::string tag(OGRFeatureH feature, const char* key) {
    for (const char* column : {key, "other_tags"}) {
        const int index = OGR_F_GetFieldIndex(feature, column);
        if (index < 0 || !OGR_F_IsFieldSetAndNotNull(feature, index)) continue;
        const std::string text = OGR_F_GetFieldAsString(feature, index);
        if (column == key) return text;
        return hstore_value(text, key);
    }
    return {};
}

/// 0: no street for cars under the sky.
double street_width_m(OGRFeatureH feature) {
    const double by_kind = width_of(tag(feature, "highway"));
    const std::string tunnel = tag(feature, "tunnel");
    if (by_kind == 0.0 || (!tunnel.empty() && tunnel != "no")) return 0.0;
    const std::string text = tag(feature, "width");
    double stated = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), stated);
    return problem == std::errc{} && stated >= 1.0 && stated <= 100.0 ? stated : by_kind;
}

void append_lines(OGRGeometryH geometry, const SiteTransform& site, double width_m,
                  std::vector<Street>& out) {
    for (int part = 0; part < OGR_G_GetGeometryCount(geometry); ++part)
        append_lines(OGR_G_GetGeometryRef(geometry, part), site, width_m, out);
    if (wkbFlatten(OGR_G_GetGeometryType(geometry)) != wkbLineString) return;
    RingPolygon points{{{}}};
    for (int i = 0; i < OGR_G_GetPointCount(geometry); ++i)
        points.rings[0].emplace_back(OGR_G_GetX(geometry, i), OGR_G_GetY(geometry, i));
    site.apply(points);
    for (const glm::dvec2& point : points.rings[0]) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) return;
    }
    if (points.rings[0].size() >= 2) out.push_back({std::move(points.rings[0]), width_m});
}

lod::Result<lod::Ok> read_layer(const std::string& path, OGRLayerH layer, const WorldFrame& world,
                                std::vector<Street>& out) {
    OGRFeatureDefnH columns = OGR_L_GetLayerDefn(layer);
    if (OGR_FD_GetFieldIndex(columns, "highway") < 0) return lod::Ok{};
    const lod::Result<SiteTransform> site = site_transform(layer, world, path);
    if (!site) return site.error();
    OGR_L_ResetReading(layer);
    while (const FeaturePtr feature{OGR_L_GetNextFeature(layer)}) {
        OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get());
        const double width_m = street_width_m(feature.get());
        if (geometry != nullptr && width_m > 0.0) append_lines(geometry, *site, width_m, out);
    }
    return lod::Ok{};
}

/// OSM sources are streams: only a query on the one layer keeps the others from piling up in memory.
lod::Result<lod::Ok> read_osm(const std::string& path, GDALDatasetH source, const WorldFrame& world,
                              std::vector<Street>& out) {
    OGRLayerH layer =
        GDALDatasetExecuteSQL(source, "SELECT * FROM lines WHERE highway IS NOT NULL", nullptr, nullptr);
    if (layer == nullptr) return lod::Ok{};
    const lod::Result<lod::Ok> read = read_layer(path, layer, world, out);
    GDALDatasetReleaseResultSet(source, layer);
    return read;
}

bool is_osm(GDALDatasetH source) {
    GDALDriverH driver = GDALGetDatasetDriver(source);
    return driver != nullptr && std::string_view(GDALGetDriverShortName(driver)) == "OSM";
}

}  // namespace

lod::Result<std::vector<Street>> read_streets(const std::string& path, const WorldFrame& world) {
    const GdalMessages messages;
    const DatasetPtr source(GDALOpenEx(
        path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr));
    if (!source) {
        return lod::Error{path + ": cannot read streets: " + messages.text("not a format OGR opens") +
                          "; expected a whole file that OGR reads"};
    }
    std::vector<Street> streets;
    lod::Result<lod::Ok> read = lod::Ok{};
    if (is_osm(source.get())) {
        read = read_osm(path, source.get(), world, streets);
    } else {
        for (int i = 0; i < GDALDatasetGetLayerCount(source.get()) && read; ++i)
            read = read_layer(path, GDALDatasetGetLayer(source.get(), i), world, streets);
    }
    if (!read) return read.error();
    if (messages.has_failed()) {
        return lod::Error{path + ": cannot read all streets: " + messages.text("") +
                          "; expected a whole file"};
    }
    return streets;
}

}  // namespace data
