// Writes the generated parts of the default scene: town.geojson and the instruments. Same program, same files.
#include <cstdio>
#include <fstream>
#include <string>

#include "data/generated_altimeter.h"
#include "data/generated_gauges.h"
#include "data/generated_town.h"
#include "data/glb_writer.h"
#include "data/world_frame.h"

namespace {

constexpr data::SitePoint kTownMiddle{-84.1680, 36.6215, 0.0};  // the floor of the valley

/// Geographic positions of points given in metres east and north of the town's middle.
class TownFrame {
  public:
    TownFrame()
        : middle_(world_.world_from_site(kTownMiddle)), world_from_enu_(world_.world_from_enu(middle_)) {}

    data::SitePoint site(const glm::dvec2& east_north_m) const {
        return world_.site_from_world(middle_ + world_from_enu_ * glm::dvec3(east_north_m, 0.0));
    }

  private:
    data::WorldFrame world_;
    glm::dvec3 middle_;
    glm::dmat3 world_from_enu_;
};

/// Seven decimals of a degree are a centimetre.
std::string point_json(const glm::dvec2& east_north_m, const TownFrame& frame) {
    const data::SitePoint site = frame.site(east_north_m);
    char point[64];
    std::snprintf(point, sizeof point, "[%.7f,%.7f]", site.x, site.y);
    return point;
}

/// A closed ring.
std::string ring_json(const std::vector<glm::dvec2>& ring, const TownFrame& frame) {
    std::string json = "[";
    for (size_t i = 0; i <= ring.size(); ++i)
        json += (i == 0 ? "" : ",") + point_json(ring[i % ring.size()], frame);
    return json + "]";
}

bool write_town(const std::string& path) {
    const TownFrame frame;
    std::ofstream file(path);
    file << "{\"type\":\"FeatureCollection\",\"features\":[";
    bool is_first = true;
    for (const data::TownBuilding& building : data::generate_town({})) {
        file << (is_first ? "\n" : ",\n") << R"({"type":"Feature","properties":{"building":"yes","height":)"
             << building.height_m << R"(},"geometry":{"type":"Polygon","coordinates":[)";
        for (size_t i = 0; i < building.rings.size(); ++i) {
            file << (i == 0 ? "" : ",") << ring_json(building.rings[i], frame);
        }
        file << "]}}";
        is_first = false;
    }
    for (const data::TownStreet& street : data::generate_streets({})) {
        file << ",\n"
             << R"({"type":"Feature","properties":{"highway":"residential","width":)"
             << data::TownOptions{}.street_width_m << R"(},"geometry":{"type":"LineString","coordinates":[)"
             << point_json(street.from, frame) << "," << point_json(street.to, frame) << "]}}";
    }
    file << "\n]}\n";
    file.close();
    return static_cast<bool>(file);
}

bool write_gauge(const std::string& path, const data::PolygonMesh& mesh) {
    const lod::Result<lod::Ok> written = data::write_glb(path, mesh);
    if (!written) std::fprintf(stderr, "%s\n", written.message().c_str());
    return static_cast<bool>(written);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_samples FOLDER\n");
        return 2;
    }
    const std::string folder = std::string(argv[1]) + "/";
    const bool is_written = write_town(folder + "town.geojson") &&
                            write_gauge(folder + "altimeter.glb", data::generate_altimeter()) &&
                            write_gauge(folder + "airspeed.glb", data::generate_airspeed_indicator()) &&
                            write_gauge(folder + "heading.glb", data::generate_heading_indicator()) &&
                            write_gauge(folder + "panel.glb", data::generate_panel());
    if (!is_written)
        std::fprintf(stderr, "%s: not all files could be written, expected a writable folder\n", argv[1]);
    return is_written ? 0 : 1;
}
