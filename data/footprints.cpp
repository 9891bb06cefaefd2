#include "data/footprints.h"

#include <gdal.h>
#include <ogr_api.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "data/feature_tags.h"
#include "data/footprint_shape.h"
#include "data/gdal_border.h"
#include "data/polygon_layer.h"
#include "data/stated_length.h"

namespace data {

namespace {

struct FeatureDestroyer {
    void operator()(void* feature) const { OGR_F_Destroy(static_cast<OGRFeatureH>(feature)); }
};
using FeaturePtr = std::unique_ptr<void, FeatureDestroyer>;

/// What every feature of a layer is read with.
struct LayerReader {
    const FootprintOptions& options;
    const WorldFrame& world;
    GEOSContextHandle_t geos;
    SiteTransform site;
    FeatureTags tags;
};

/// Metres on a plane at one place; longitudes are continuous across the antimeridian.
struct LocalPlane {
    glm::dvec2 origin_site{0.0};
    glm::dvec2 metres_per_unit{1.0};
    bool wraps = false;

    glm::dvec2 local_from_site(const glm::dvec2& site) const {
        glm::dvec2 way = site - origin_site;
        if (wraps) way.x = std::remainder(way.x, 360.0);
        return way * metres_per_unit;
    }
    glm::dvec2 site_from_local(const glm::dvec2& local) const {
        return origin_site + local / metres_per_unit;
    }
};

LocalPlane plane_at(const glm::dvec2& site, const WorldFrame& world) {
    if (!world.has_datum) return {.origin_site = site};
    constexpr double kMetresPerDegree = 111'195.0;  // of a sphere; only proportions matter here
    const double shrink = std::max(std::cos(site.y * std::numbers::pi / 180.0), 1e-6);
    return {site, {kMetresPerDegree * shrink, kMetresPerDegree}, true};
}

/// Footprints of one polygon in layer coordinates; `is_repaired` is set when it was not valid.
std::vector<Footprint> footprints_of(const LayerReader& reader, RingPolygon polygon, bool& is_repaired) {
    reader.site.apply(polygon);
    const LocalPlane plane = plane_at(polygon.rings[0][0], reader.world);
    for (std::vector<glm::dvec2>& ring : polygon.rings) {
        for (glm::dvec2& point : ring) {
            point = plane.local_from_site(point);
            if (!std::isfinite(point.x) || !std::isfinite(point.y)) return {};
        }
    }
    ValidPolygons valid = make_valid(reader.geos, polygon);
    std::vector<Footprint> footprints;
    for (RingPolygon& part : valid.parts) {
        Footprint footprint;
        footprint.triangles = triangulate(reader.geos, part);
        if (footprint.triangles.empty()) continue;
        for (std::vector<glm::dvec2>& ring : part.rings) {
            for (glm::dvec2& point : ring)
                point = plane.site_from_local(point);
        }
        footprint.rings = std::move(part.rings);
        footprints.push_back(std::move(footprint));
    }
    is_repaired |= valid.is_repaired && !footprints.empty();
    return footprints;
}

void read_feature(const LayerReader& reader, OGRFeatureH feature, Footprints& out) {
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr || !reader.tags.is_building(feature)) return;
    std::vector<RingPolygon> polygons;
    append_ring_polygons(geometry, polygons);
    if (polygons.empty() && OGR_G_GetDimension(geometry) < 2) return;

    FootprintStats& stats = out.stats;
    const int64_t id = reader.tags.id(feature, static_cast<int64_t>(stats.read));
    const BuildingHeight height =
        building_height(reader.tags.read(feature), reader.options.default_height_m, reader.options.storey_m);
    ++stats.read;
    bool is_repaired = false;
    const size_t before = out.buildings.size();
    for (RingPolygon& polygon : polygons) {
        for (Footprint& footprint : footprints_of(reader, std::move(polygon), is_repaired)) {
            footprint.height_m = height.height_m;
            footprint.min_height_m = height.min_height_m;
            footprint.id = id;
            stats.courtyards += footprint.rings.size() - 1;
            out.buildings.push_back(std::move(footprint));
        }
    }
    if (out.buildings.size() == before) {
        ++stats.skipped;
        return;
    }
    ++stats.kept;
    stats.repaired += is_repaired ? 1u : 0u;
    stats.with_height += height.has_height ? 1u : 0u;
    stats.with_levels += height.has_levels ? 1u : 0u;
    stats.by_default += !height.has_height && !height.has_levels ? 1u : 0u;
}

/// An open data source, and how it is to be read.
struct FootprintSource {
    const std::string& path;
    const WorldFrame& world;
    const FootprintOptions& options;
    GDALDatasetH dataset;

    bool is_of(std::string_view driver) const {
        GDALDriverH own = GDALGetDatasetDriver(dataset);
        return own != nullptr && driver == GDALGetDriverShortName(own);
    }
};

/// How many features a layer must have: FlatGeobuf's header says it, and OGR ends early where some are missing.
GIntBig stated_features(const FootprintSource& source, OGRLayerH layer) {
    return source.is_of("FlatGeobuf") ? OGR_L_GetFeatureCount(layer, FALSE) : 0;
}

/// @returns whether the layer may hold areas
lod::Result<bool> read_layer(const FootprintSource& source, OGRLayerH layer, Footprints& out) {
    OGRFeatureDefnH columns = OGR_L_GetLayerDefn(layer);
    const OGRwkbGeometryType kind = wkbFlatten(OGR_FD_GetGeomType(columns));
    const bool has_areas = kind == wkbUnknown || kind == wkbGeometryCollection ||
                           OGR_GT_IsSubClassOf(kind, wkbSurface) ||
                           OGR_GT_IsSubClassOf(kind, wkbMultiSurface);
    if (!has_areas) return false;
    lod::Result<SiteTransform> site = site_transform(layer, source.world, source.path);
    if (!site) return site.error();
    const GeosContextPtr geos = make_geos_context();
    const LayerReader reader{source.options, source.world, geos.get(), std::move(*site),
                             FeatureTags(columns)};
    const uint64_t read_before = out.stats.read;
    const GIntBig stated = stated_features(source, layer);
    GIntBig met = 0;
    OGR_L_ResetReading(layer);
    while (const FeaturePtr feature{OGR_L_GetNextFeature(layer)}) {
        read_feature(reader, static_cast<OGRFeatureH>(feature.get()), out);
        ++met;
    }
    if (met < stated) {
        return lod::Error{source.path + ": truncated: " + std::to_string(met) + " features; expected " +
                          std::to_string(stated) + ", as its header says"};
    }
    return kind != wkbUnknown || out.stats.read > read_before;
}

/// OSM sources are streams: only a query on the one layer keeps the others from piling up in memory.
lod::Result<bool> read_osm(const FootprintSource& source, Footprints& out) {
    OGRLayerH layer = GDALDatasetExecuteSQL(
        source.dataset, "SELECT * FROM multipolygons WHERE building IS NOT NULL", nullptr, nullptr);
    if (layer == nullptr) return false;
    const lod::Result<bool> has_areas = read_layer(source, layer, out);
    GDALDatasetReleaseResultSet(source.dataset, layer);
    return has_areas;
}

lod::Result<bool> read_all_layers(const FootprintSource& source, Footprints& out) {
    bool has_areas = false;
    for (int i = 0; i < GDALDatasetGetLayerCount(source.dataset); ++i) {
        const lod::Result<bool> layer = read_layer(source, GDALDatasetGetLayer(source.dataset, i), out);
        if (!layer) return layer.error();
        has_areas |= *layer;
    }
    return has_areas;
}

}  // namespace

lod::Result<Footprints> read_footprints(const std::string& path, const WorldFrame& world,
                                        const FootprintOptions& options) {
    const GdalMessages messages;
    const DatasetPtr dataset(GDALOpenEx(
        path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr));
    if (!dataset) {
        return lod::Error{path + ": cannot read footprints: " + messages.text("not a format OGR opens") +
                          "; expected a whole file of polygons that OGR reads"};
    }
    if (const std::optional<std::string> problem = length_problem(dataset.get(), path))
        return lod::Error{path + ": cannot read all footprints: " + *problem};
    const FootprintSource source{path, world, options, dataset.get()};
    Footprints out;
    const lod::Result<bool> has_areas =
        source.is_of("OSM") ? read_osm(source, out) : read_all_layers(source, out);
    if (!has_areas) return has_areas.error();
    if (messages.has_failed()) {
        return lod::Error{path + ": cannot read all footprints: " + messages.text("") +
                          "; expected a whole file"};
    }
    if (!*has_areas) return lod::Error{path + ": no areas in any layer; expected polygons of buildings"};
    return out;
}

}  // namespace data
