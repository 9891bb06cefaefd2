// Footprints cut at every kilobyte: refused in one line. Formats of lines, which do not state their length, may be
// smaller by whole lines.
#include <gtest/gtest.h>
#include <ogr_api.h>

#include <fstream>
#include <sstream>

#include "data/footprints.h"
#include "data/gdal_border.h"
#include "tests/data/cut_files.h"
#include "tests/data/raster_writer.h"

namespace {

using test::CutFolder;
using test::CutOutcome;

const data::WorldFrame kEarth{true};

/// @param part  the file to cut, where it is not the one that is opened
CutOutcome cut_footprints(const std::string& path, const std::string& part = "", size_t step_bytes = 1024) {
    const auto whole = data::read_footprints(path, kEarth, {});
    EXPECT_TRUE(whole) << whole.message();
    return test::cut_down(
        part.empty() ? path : part, std::filesystem::path(path).filename().string(),
        [&]() -> std::optional<std::string> {
            const auto read = data::read_footprints(path, kEarth, {});
            if (!read) return read.message();
            return std::nullopt;
        },
        step_bytes);
}

constexpr int kHouses = 150;

/// Houses of 1" in a row, with a height, in any format OGR writes.
void write_houses(const std::string& path, const char* driver, const std::vector<std::string>& creation) {
    GDALAllRegister();
    char** options = nullptr;
    for (const std::string& option : creation)
        options = CSLAddString(options, option.c_str());
    const data::DatasetPtr file(
        GDALCreate(GDALGetDriverByName(driver), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    ASSERT_TRUE(file);
    OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(crs, "OGC:CRS84");
    OGRLayerH layer = GDALDatasetCreateLayer(file.get(), "houses", crs, wkbPolygon, options);
    OSRRelease(crs);
    CSLDestroy(options);
    OGRFieldDefnH height = OGR_Fld_Create("height", OFTReal);
    OGR_L_CreateField(layer, height, TRUE);
    OGR_Fld_Destroy(height);
    for (int i = 0; i < kHouses; ++i) {
        const double west = 7.0 + i * 0.001, size = 0.0003;
        std::ostringstream text;
        text << "POLYGON ((" << west << " 43, " << west + size << " 43, " << west + size << " " << 43 + size
             << ", " << west << " " << 43 + size << ", " << west << " 43))";
        const std::string wkt = text.str();
        char* rest = const_cast<char*>(wkt.c_str());
        OGRGeometryH outline = nullptr;
        ASSERT_EQ(OGR_G_CreateFromWkt(&rest, nullptr, &outline), OGRERR_NONE);
        OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        OGR_F_SetFieldDouble(feature, 0, 5.0 + i % 20);
        OGR_F_SetGeometryDirectly(feature, outline);
        EXPECT_EQ(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
        OGR_F_Destroy(feature);
    }
}

TEST(CutFootprints, FormatsThatStateTheirEndAreRefused) {
    struct Case {
        const char *name, *driver;
    };
    for (const Case& item :
         {Case{"houses.gpkg", "GPKG"}, Case{"houses.sqlite", "SQLite"}, Case{"houses.geojson", "GeoJSON"},
          Case{"houses.fgb", "FlatGeobuf"}, Case{"houses.kml", "KML"}, Case{"houses.gml", "GML"}}) {
        SCOPED_TRACE(item.name);
        const CutFolder folder;
        write_houses(folder.file(item.name), item.driver, {});
        const CutOutcome outcome = cut_footprints(folder.file(item.name));
        EXPECT_GT(outcome.refused, 15u);
        EXPECT_TRUE(outcome.read_at.empty()) << outcome.read_at.front();
    }
}

TEST(CutFootprints, FormatsOfLinesAreSmallerByWholeLinesOrRefused) {
    struct Case {
        const char *name, *driver;
        std::vector<std::string> creation;
    };
    for (const Case& item :
         {Case{"houses.geojsonl", "GeoJSONSeq", {}}, Case{"houses.csv", "CSV", {"GEOMETRY=AS_WKT"}}}) {
        SCOPED_TRACE(item.name);
        const CutFolder folder;
        const std::string path = folder.file(item.name);
        write_houses(path, item.driver, item.creation);
        std::ifstream file(path);
        const std::string content{std::istreambuf_iterator<char>(file), {}};
        const CutOutcome outcome = cut_footprints(path);
        EXPECT_GT(outcome.refused, 10u);
        for (const size_t length : outcome.read_at)
            EXPECT_EQ(content[length - 1], '\n') << length;
        // Between two lines it is a smaller file, and valid.
        const size_t middle = content.find('\n', content.size() / 2) + 1;
        std::ofstream(path) << content.substr(0, middle);
        const auto smaller = data::read_footprints(path, kEarth, {});
        ASSERT_TRUE(smaller) << smaller.message();
        EXPECT_LT(smaller->stats.kept, uint64_t{kHouses});
        EXPECT_NEAR(static_cast<double>(smaller->stats.kept), kHouses / 2.0, 20.0);
    }
}

TEST(CutFootprints, ShapefilesOfSeveralFiles) {
    for (const char* part : {"shp", "shx", "dbf"}) {
        SCOPED_TRACE(part);
        const CutFolder folder;
        write_houses(folder.file("houses.shp"), "ESRI Shapefile", {});
        const CutOutcome outcome = cut_footprints(folder.file("houses.shp"), folder.file("houses.") + part);
        EXPECT_GE(outcome.refused, 2u);
        EXPECT_TRUE(outcome.read_at.empty()) << outcome.read_at.front();
    }
}

TEST(CutFootprints, OsmXml) {
    const CutFolder folder;
    std::ofstream file(folder.file("houses.osm"));
    file << "<?xml version='1.0' encoding='UTF-8'?>\n<osm version=\"0.6\">\n";
    constexpr double kCorners[4][2] = {{0, 0}, {3e-4, 0}, {3e-4, 3e-4}, {0, 3e-4}};
    for (int i = 0; i < kHouses; ++i) {
        for (int k = 0; k < 4; ++k) {
            file << "<node id=\"" << 4 * i + k + 1 << "\" lat=\"" << 43 + kCorners[k][1] << "\" lon=\""
                 << 7 + i * 1e-3 + kCorners[k][0] << "\"/>\n";
        }
    }
    for (int i = 0; i < kHouses; ++i) {
        file << "<way id=\"" << i + 1 << "\">";
        for (int k = 0; k < 5; ++k)
            file << "<nd ref=\"" << 4 * i + k % 4 + 1 << "\"/>";
        file << "<tag k=\"building\" v=\"yes\"/></way>\n";
    }
    file << "</osm>\n";
    file.close();
    EXPECT_TRUE(cut_footprints(folder.file("houses.osm")).read_at.empty());
}

TEST(CutFootprints, RealExtractsAndShapefile) {
    if (!test::exists(test::real_data("city"))) GTEST_SKIP() << "no shared/data beside the project";
    const CutFolder folder;
    EXPECT_TRUE(cut_footprints(folder.copy(test::real_data("city/nyc.osm.pbf"))).read_at.empty());
    const std::string monaco = folder.copy(test::real_data("monaco/monaco-2021.osm.pbf"));
    EXPECT_TRUE(cut_footprints(monaco, "", 64 * 1024).read_at.empty());
    for (const char* part : {"shx", "dbf", "prj"})
        folder.copy(test::real_data("somerset/buildings.") + part);
    const std::string shapes = folder.copy(test::real_data("somerset/buildings.shp"));
    EXPECT_TRUE(cut_footprints(shapes, "", 4096).read_at.empty());
}

}  // namespace
