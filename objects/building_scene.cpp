#include "objects/building_scene.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <limits>

#include "data/city_json.h"
#include "data/ground_height.h"
#include "objects/building_mesh.h"

namespace objects {

namespace {

constexpr uint64_t kColourSeed = 1;  // as static buildings have it

/// The scene frame at the middle of all outer rings.
struct SceneFrame {
    glm::dvec3 origin_site{0.0}, origin_world{0.0};
    glm::dmat3 enu_from_world{1.0};
};

SceneFrame frame_of(const data::Footprints& footprints, const BuildingGround& ground) {
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    for (const data::Footprint& footprint : footprints.buildings) {
        for (const glm::dvec2& point : footprint.rings[0]) {
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
    }
    SceneFrame frame;
    if (footprints.buildings.empty()) return frame;
    const glm::dvec2 middle = (low + high) / 2.0;
    const double height_m =
        ground.grid ? data::ground_height(*ground.grid, {middle.x, middle.y, 0.0}).height_m : 0.0;
    frame.origin_site = {middle, height_m};
    frame.origin_world = ground.world.world_from_site({middle.x, middle.y, height_m});
    frame.enu_from_world = glm::transpose(ground.world.world_from_enu(frame.origin_world));
    return frame;
}

/// Appends a building to an object's mesh; flat shaded, so every corner takes the normal of its triangle.
void append_building(const BuildingMesh& building, const SceneFrame& frame, const glm::dvec3& base_scene,
                     data::TimedMesh& mesh) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const lod::Vertex& vertex : building.vertices) {
        const auto at = [&](int axis) {
            return static_cast<double>(vertex.position_hi[axis]) +
                   static_cast<double>(vertex.position_lo[axis]);
        };
        const glm::dvec3 scene =
            frame.enu_from_world * (glm::dvec3(at(0), at(1), at(2)) - frame.origin_world);
        mesh.positions.emplace_back(scene - base_scene);
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
        mesh.colours.emplace_back(vertex.colour[0], vertex.colour[1], vertex.colour[2], uint8_t{255});
    }
    for (size_t i = 0; i < building.indices.size(); i += 3) {
        const std::array<uint32_t, 3> triangle = {
            first + building.indices[i], first + building.indices[i + 1], first + building.indices[i + 2]};
        const glm::dvec3 a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]),
            c(mesh.positions[triangle[2]]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        if (glm::length(normal) > 0.0) {
            for (uint32_t corner : triangle)
                mesh.normals[corner] = glm::vec3(glm::normalize(normal));
        }
        mesh.triangles.push_back(triangle);
    }
}

bool is_footprints(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array kKnown = {".osm", ".pbf", ".shp", ".gpkg", ".geojson", ".fgb", ".gml", ".kml"};
    if (extension == ".json") return !data::is_city_json(path);
    return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

/// In degrees where the source can be, else in the source's own plane.
lod::Result<data::Footprints> read_somewhere(const std::string& path, BuildingGround& ground) {
    auto footprints = data::read_footprints(path, ground.world, {});
    if (footprints || ground.grid != nullptr || !ground.world.has_datum) return footprints;
    auto plane = data::read_footprints(path, data::WorldFrame{.has_datum = false}, {});
    if (!plane) return footprints;
    ground.world.has_datum = false;
    return plane;
}

}  // namespace

data::SourceScene building_scene(const data::Footprints& footprints, const BuildingGround& ground) {
    const SceneFrame frame = frame_of(footprints, ground);
    data::SourceScene scene;
    scene.origin_site = frame.origin_site;
    scene.is_on_earth = ground.world.has_datum;
    const Ground place{ground.grid, ground.world};
    BuildingMesh building;
    data::UniqueIds ids;
    int64_t last_id = 0;
    for (size_t i = 0; i < footprints.buildings.size(); ++i) {
        const data::Footprint& footprint = footprints.buildings[i];
        if (!mesh_building(place, footprint, building_colours(kColourSeed, footprint.id, footprint.height_m),
                           building))
            continue;
        if (scene.objects.empty() || last_id != footprint.id) {
            last_id = footprint.id;
            data::KeyFrame base;
            base.position = frame.enu_from_world * (building.base_world - frame.origin_world);
            scene.objects.push_back({ids.take(std::to_string(footprint.id), i + 1),
                                     static_cast<uint32_t>(scene.meshes.size()),
                                     {},
                                     {base}});
            scene.meshes.emplace_back();
        }
        append_building(building, frame, scene.objects.back().keys[0].position, scene.meshes.back());
    }
    return scene;
}

lod::Result<data::TimedScene> read_timed_scene(const std::string& path,
                                               const data::TimedSceneOptions& options,
                                               const BuildingGround& ground) {
    if (!is_footprints(path)) return data::read_timed_scene(path, options);
    BuildingGround place = ground;
    const auto footprints = read_somewhere(path, place);
    if (!footprints) return footprints.error();
    return data::give_schedule(path, options, [&](const data::Schedule&) -> lod::Result<data::SourceScene> {
        return building_scene(*footprints, place);
    });
}

}  // namespace objects
