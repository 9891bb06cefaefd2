#include "data/footprints.h"

#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "data/footprint_shape.h"
#include "lod/base/rng.h"
#include "tests/data/own_path.h"

namespace {

namespace fs = std::filesystem;
using data::Footprint;
using data::Footprints;
using Ring = std::vector<glm::dvec2>;

const data::WorldFrame kPlane{false}, kEarth{true};

fs::path shared_data() {
    return fs::path(HARRIER_SOURCE_DIR) / "../shared/data";
}

std::string write_file(const std::string& name, const std::string& content) {
    const std::string path = test::own_path(name);
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

// The text of a GeoJSON feature.
std::string feature(const std::string& geometry, const std::string& properties = "") {
    return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":)" + geometry + "}";
}
std::string collection(const std::vector<std::string>& features) {
    std::string text = R"({"type":"FeatureCollection","features":[)";
    for (size_t i = 0; i < features.size(); ++i)
        text += (i > 0 ? "," : "") + features[i];
    return text + "]}";
}
std::string ring_text(const Ring& ring) {
    std::ostringstream text;
    text.precision(17);
    for (size_t i = 0; i <= ring.size(); ++i)
        text << (i == 0 ? "[" : ",") << "[" << ring[i % ring.size()].x << "," << ring[i % ring.size()].y
             << "]";
    return text.str() + "]";
}
std::string polygon_text(const std::vector<Ring>& rings) {
    std::string text;
    for (const Ring& ring : rings)
        text += (text.empty() ? "" : ",") + ring_text(ring);
    return R"({"type":"Polygon","coordinates":[)" + text + "]}";
}

lod::Result<Footprints> read_geojson(const std::string& name, const std::vector<std::string>& features,
                                     const data::WorldFrame& world = kPlane) {
    return data::read_footprints(write_file(name + ".geojson", collection(features)), world, {});
}

double shoelace(const Ring& ring) {
    double sum = 0.0;
    for (size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
        sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return sum;
}

double ring_area(const Footprint& footprint) {
    double area = 0.0;
    for (const Ring& ring : footprint.rings)
        area += shoelace(ring);
    return area;
}

// Everything footprints.h promises of one building.
void check_promises(const Footprint& footprint) {
    ASSERT_FALSE(footprint.rings.empty());
    Ring points;
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t r = 0; r < footprint.rings.size(); ++r) {
        const Ring& ring = footprint.rings[r];
        ASSERT_GE(ring.size(), 3u);
        EXPECT_GT(shoelace(ring) * (r == 0 ? 1.0 : -1.0), 0.0) << "ring " << r;
        const uint32_t first = static_cast<uint32_t>(points.size()),
                       count = static_cast<uint32_t>(ring.size());
        for (uint32_t i = 0; i < count; ++i) {
            EXPECT_NE(ring[i], ring[(i + 1) % count]);
            ++edges[{first + i, first + (i + 1) % count}];
        }
        points.insert(points.end(), ring.begin(), ring.end());
    }
    double covered = 0.0;
    for (const auto& [a, b, c] : footprint.triangles) {
        ASSERT_LT(std::max({a, b, c}), points.size());
        const double area = shoelace({points[a], points[b], points[c]});
        EXPECT_GE(area, 0.0);
        covered += area;
        --edges[{a, b}], --edges[{b, c}], --edges[{c, a}];
    }
    EXPECT_NEAR(covered, ring_area(footprint), 1e-9 * covered);
    // Ring edges bound one triangle on the inner side, all others two: what is left pairs up.
    for (const auto& [edge, count] : edges) {
        if (count == 0) continue;
        const auto twin = edges.find({edge.second, edge.first});
        ASSERT_NE(twin, edges.end());
        EXPECT_EQ(count, -1);
        EXPECT_EQ(twin->second, -1);
    }
    EXPECT_GT(footprint.height_m, footprint.min_height_m);
    EXPECT_GE(footprint.min_height_m, 0.0);
}

TEST(Footprints, KeepsCourtyardsAndOrientsRings) {
    const Ring outer{{0, 0}, {0, 10}, {20, 10}, {20, 0}},
        yard{{5, 2}, {15, 2}, {15, 8}, {5, 8}};  // both the wrong way
    const auto read =
        read_geojson("yard", {feature(polygon_text({outer, yard}), R"("height":12.5,"id":77)")});
    ASSERT_TRUE(read) << read.message();
    ASSERT_EQ(read->buildings.size(), 1u);
    const Footprint& building = read->buildings[0];
    check_promises(building);
    EXPECT_EQ(building.rings.size(), 2u);
    EXPECT_EQ(building.triangles.size(), 8u);
    EXPECT_NEAR(ring_area(building), 200.0 - 60.0, 1e-12);
    EXPECT_EQ(building.height_m, 12.5);
    EXPECT_EQ(building.id, 77);
    EXPECT_EQ(read->stats.courtyards, 1u);
    EXPECT_EQ(read->stats.with_height, 1u);
}

TEST(Footprints, DropsPointsThatAddNothing) {
    // A square with a repeated corner, a point on an edge and a spike.
    const Ring messy{{0, 0}, {0, 0}, {5, 0}, {10, 0}, {10, 4}, {13, 4}, {10, 4}, {10, 10}, {0, 10}};
    const auto read = read_geojson("messy", {feature(polygon_text({messy}))});
    ASSERT_TRUE(read) << read.message();
    ASSERT_EQ(read->buildings.size(), 1u);
    check_promises(read->buildings[0]);
    EXPECT_EQ(read->buildings[0].rings[0].size(), 4u);
    EXPECT_NEAR(ring_area(read->buildings[0]), 100.0, 1e-12);
}

TEST(Footprints, RepairsWhatCrossesItselfAndSkipsWhatHasNoArea) {
    const Ring bow{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, flat{{0, 0}, {5, 5}, {10, 10}},
        square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::string two = R"({"type":"MultiPolygon","coordinates":[[)" + ring_text(square) + "],[" +
                            ring_text({{5, 5}, {7, 5}, {7, 7}}) + "]]}";
    const auto read =
        read_geojson("broken", {feature(polygon_text({bow})), feature(polygon_text({flat})), feature(two),
                                feature("null"), feature(R"({"type":"Point","coordinates":[1,2]})")});
    ASSERT_TRUE(read) << read.message();
    EXPECT_EQ(read->stats.read, 3u);
    EXPECT_EQ(read->stats.kept, 2u);
    EXPECT_EQ(read->stats.repaired, 1u);
    EXPECT_EQ(read->stats.skipped, 1u);
    ASSERT_EQ(read->buildings.size(), 4u);
    for (const Footprint& building : read->buildings)
        check_promises(building);
    EXPECT_NEAR(ring_area(read->buildings[0]) + ring_area(read->buildings[1]), 50.0, 1e-9);
    EXPECT_EQ(read->buildings[2].id, read->buildings[3].id);
}

TEST(Footprints, BuildingColumnSaysWhatIsBuilt) {
    const std::string square = polygon_text({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
    const auto read =
        read_geojson("column", {feature(square, R"("building":"no")"), feature(square, R"("building":null)"),
                                feature(square, R"("building":"construction","building:levels":"4")")});
    ASSERT_TRUE(read) << read.message();
    ASSERT_EQ(read->buildings.size(), 1u);
    EXPECT_NEAR(read->buildings[0].height_m, 4 * 3.2, 1e-12);
}

// Rings around one another in polar form, rough, with round courtyards: any mistake in the triangles shows in the area
// or in the edges.
TEST(Footprints, TrianglesCoverRandomBuildings) {
    lod::Rng rng(11);
    std::vector<std::string> features;
    std::vector<double> areas;
    for (int n = 0; n < 150; ++n) {
        const auto rough = [&](glm::dvec2 centre, size_t count, double low, double high) {
            Ring ring;
            for (size_t i = 0; i < count; ++i) {
                const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5 * rng.unit()) /
                                     static_cast<double>(count);
                ring.push_back(centre +
                               rng.between(low, high) * glm::dvec2(std::cos(angle), std::sin(angle)));
            }
            return ring;
        };
        std::vector<Ring> rings{rough({0, 0}, 8 + rng.below(60), 60, 100)};
        for (uint64_t h = rng.below(5); h > 0; --h) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(h) / 5.0;
            rings.push_back(
                rough(glm::dvec2(std::cos(angle), std::sin(angle)) * 25.0, 3 + rng.below(9), 5, 12));
        }
        double area = shoelace(rings[0]);
        for (size_t i = 1; i < rings.size(); ++i)
            area -= shoelace(rings[i]);
        areas.push_back(area);
        features.push_back(feature(polygon_text(rings)));
    }
    const auto read = read_geojson("random", features);
    ASSERT_TRUE(read) << read.message();
    ASSERT_EQ(read->buildings.size(), areas.size());
    for (size_t i = 0; i < areas.size(); ++i) {
        SCOPED_TRACE(i);
        const Footprint& building = read->buildings[i];
        check_promises(building);
        EXPECT_NEAR(ring_area(building), areas[i], 1e-6 * areas[i]);  // GeoJSON is read to 15 digits
        size_t points = 0;
        for (const Ring& ring : building.rings)
            points += ring.size();
        EXPECT_EQ(building.triangles.size(), points + 2 * (building.rings.size() - 1) - 2);
    }
}

TEST(Footprints, CourtyardsMayTouchAtACorner) {
    const Ring outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    const std::vector<std::vector<Ring>> cases{
        {outer, {{0, 0}, {2, 4}, {4, 2}}},  // the outer ring's corner
        {outer, {{0, 5}, {3, 4}, {3, 6}}},  // the outer ring's edge
        {{{0, 0}, {10, 0}, {13, 10}, {0, 10}},
         {{11, 10.0 / 3.0}, {8, 3}, {8, 5}}},                         // nearly: a third is not exact
        {outer, {{2, 2}, {2, 4}, {5, 5}}, {{5, 5}, {8, 6}, {8, 8}}},  // each other
        {outer,
         {{1, 1}, {1, 9}, {2, 9}, {2, 1}},
         {{3, 1}, {3, 9}, {4, 9}, {4, 1}},
         {{5, 1}, {5, 9}, {6, 9}, {6, 1}}},
    };
    const data::GeosContextPtr geos = data::make_geos_context();
    for (size_t i = 0; i < cases.size(); ++i) {
        SCOPED_TRACE(i);
        const data::ValidPolygons valid = data::make_valid(geos.get(), {cases[i]});
        ASSERT_EQ(valid.parts.size(), 1u);
        const data::Triangles triangles = data::triangulate(geos.get(), valid.parts[0]);
        Ring points;
        for (const Ring& ring : valid.parts[0].rings)
            points.insert(points.end(), ring.begin(), ring.end());
        double covered = 0.0, wanted = 0.0;
        for (const auto& [a, b, c] : triangles)
            covered += shoelace({points[a], points[b], points[c]});
        for (const Ring& ring : cases[i])
            wanted += (wanted == 0.0 ? 1.0 : -1.0) * std::abs(shoelace(ring));
        EXPECT_NEAR(covered, wanted, 1e-8);
    }
}

TEST(Footprints, AntimeridianDoesNotTearABuilding) {
    const auto read = read_geojson(
        "antimeridian",
        {feature(
            polygon_text({{{179.9999, 10}, {-179.9999, 10}, {-179.9999, 10.0001}, {179.9999, 10.0001}}}))},
        kEarth);
    ASSERT_TRUE(read) << read.message();
    ASSERT_EQ(read->buildings.size(), 1u);
    EXPECT_NEAR(ring_area(read->buildings[0]), 2e-4 * 1e-4, 1e-14);
}

TEST(Footprints, UnusableSourcesAreRefusedInOneLine) {
    const std::string line = feature(R"({"type":"LineString","coordinates":[[0,0],[1,1]]})");
    const std::string paths[] = {
        "/nonexistent.osm.pbf",
        write_file("empty.geojson", ""),
        write_file("noise.osm.pbf", "noise"),
        write_file("line.geojson", collection({line})),
    };
    for (const std::string& path : paths) {
        const auto read = data::read_footprints(path, kEarth, {});
        ASSERT_FALSE(read) << path;
        EXPECT_NE(read.message().find(path), std::string::npos) << read.message();
        EXPECT_EQ(read.message().find('\n'), std::string::npos);
    }
}

TEST(Footprints, TruncatedSourcesAreRefused) {
    const std::string square = polygon_text({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
    const std::string whole = collection({feature(square), feature(square)});
    for (size_t length = 0; length < whole.size(); length += 7) {
        EXPECT_FALSE(data::read_footprints(write_file("cut.geojson", whole.substr(0, length)), kPlane, {}))
            << length;
    }
}

// Sum of the polygons' areas in the layer's own units, by OGR.
double ogr_area(const fs::path& path, const char* query) {
    GDALAllRegister();
    const GDALDatasetUniquePtr source(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
    OGRLayer* layer = source->ExecuteSQL(query, nullptr, nullptr);
    double area = 0.0;
    for (const OGRFeatureUniquePtr& item : layer)
        area += OGR_G_Area(OGRGeometry::ToHandle(item->GetGeometryRef()));
    source->ReleaseResultSet(layer);
    return area;
}

TEST(Footprints, ReadsMonaco) {
    const fs::path path = shared_data() / "monaco/monaco-2021.osm.pbf";
    if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
    const auto read = data::read_footprints(path.string(), kEarth, {});
    ASSERT_TRUE(read) << read.message();
    EXPECT_EQ(read->stats.read, 1207u);
    EXPECT_EQ(read->stats.kept, 1207u);
    EXPECT_EQ(read->stats.repaired, 1u);
    EXPECT_EQ(read->stats.with_height, 35u);
    EXPECT_EQ(read->stats.with_levels, 101u);
    double area = 0.0;
    uint64_t with_courtyard = 0;
    for (const Footprint& building : read->buildings) {
        check_promises(building);
        area += ring_area(building);
        with_courtyard += building.rings.size() > 1 ? 1u : 0u;
    }
    EXPECT_EQ(with_courtyard, 22u);
    const double wanted = ogr_area(path, "SELECT * FROM multipolygons WHERE building IS NOT NULL");
    EXPECT_NEAR(area, wanted, 1e-3 * wanted);  // one of them crosses itself
}

TEST(Footprints, ReadsNewYorkAndSomerset) {
    const fs::path nyc = shared_data() / "city/nyc.osm.pbf",
                   somerset = shared_data() / "somerset/buildings.shp";
    if (!fs::exists(nyc) || !fs::exists(somerset)) GTEST_SKIP() << "no " << nyc << " or " << somerset;
    const auto city = data::read_footprints(nyc.string(), kEarth, {});
    ASSERT_TRUE(city) << city.message();
    EXPECT_EQ(city->stats.kept, 1520u);
    EXPECT_EQ(city->stats.with_height, 1509u);

    const auto plane = data::read_footprints(somerset.string(), kPlane, {});
    ASSERT_TRUE(plane) << plane.message();
    EXPECT_EQ(plane->buildings.size(), 401u);
    double area_m2 = 0.0;
    for (const Footprint& building : plane->buildings) {
        check_promises(building);
        area_m2 += ring_area(building);
    }
    const double wanted_m2 = ogr_area(somerset, "SELECT * FROM buildings");
    EXPECT_NEAR(area_m2, wanted_m2, 1e-6 * wanted_m2);

    // The same on the Earth: areas there agree with the map's within its scale.
    const auto earth = data::read_footprints(somerset.string(), kEarth, {});
    ASSERT_TRUE(earth) << earth.message();
    double earth_m2 = 0.0;
    for (const Footprint& building : earth->buildings) {
        const glm::dvec2 origin = building.rings[0][0];
        const glm::dvec3 here = kEarth.world_from_site({origin.x, origin.y, 0.0});
        const glm::dmat3 enu_from_world = glm::transpose(kEarth.world_from_enu(here));
        for (const Ring& ring : building.rings) {
            Ring metres;
            for (const glm::dvec2& point : ring)
                metres.emplace_back(enu_from_world *
                                    (kEarth.world_from_site({point.x, point.y, 0.0}) - here));
            earth_m2 += shoelace(metres);
        }
    }
    EXPECT_NEAR(earth_m2, wanted_m2, 1e-3 * wanted_m2);
}

}  // namespace
