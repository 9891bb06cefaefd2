#include "data/city_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "data/file_bytes.h"
#include "data/footprint_shape.h"
#include "data/geodetic_transform.h"
#include "data/world_frame.h"

namespace data {

namespace {

using Json = nlohmann::json;
constexpr size_t kMaxBytes = size_t{4} << 30;
const Json kNothing;

/// A member, or null where there is none.
const Json& member(const Json& object, const char* name) {
    if (!object.is_object()) return kNothing;
    const auto found = object.find(name);
    return found == object.end() ? kNothing : *found;
}

bool read_triple(const Json& array, glm::dvec3& out) {
    if (!array.is_array() || array.size() != 3) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const Json& value = array[static_cast<size_t>(axis)];
        if (!value.is_number()) return false;
        out[axis] = value.get<double>();
    }
    return std::isfinite(out.x) && std::isfinite(out.y) && std::isfinite(out.z);
}

/// The city's points in the scene frame, and where that is.
struct City {
    std::vector<glm::dvec3> points;
    glm::dvec3 origin_site{0.0};
    bool is_on_earth = false;
};

lod::Result<std::vector<glm::dvec3>> read_vertices(const Json& root, const std::string& path) {
    glm::dvec3 scale(1.0), translate(0.0);
    const Json& transform = member(root, "transform");
    if (!transform.is_null() && (!read_triple(member(transform, "scale"), scale) ||
                                 !read_triple(member(transform, "translate"), translate)))
        return lod::Error{path + ": transform has no scale and translate, expected three numbers each"};
    const Json& vertices = member(root, "vertices");
    if (!vertices.is_array()) return lod::Error{path + ": no vertices, expected an array of them"};
    std::vector<glm::dvec3> points(vertices.size());
    for (size_t i = 0; i < points.size(); ++i) {
        if (!read_triple(vertices[i], points[i]))
            return lod::Error{path + ": vertex " + std::to_string(i) +
                              " is no point, expected three numbers"};
        points[i] = points[i] * scale + translate;
    }
    return points;
}

/// "EPSG:7415" of "https://www.opengis.net/def/crs/EPSG/0/7415" or "urn:ogc:def:crs:EPSG::7415"; empty: none stated.
std::string crs_of(const Json& root) {
    const Json& system = member(member(root, "metadata"), "referenceSystem");
    if (!system.is_string()) return {};
    const std::string text = system.get<std::string>();
    return "EPSG:" + text.substr(text.find_last_of("/:") + 1);
}

/// Takes the points from their CRS to east, north and up at their middle.
lod::Result<City> place_city(std::vector<glm::dvec3> points, const std::string& crs,
                             const std::string& path) {
    City city;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const glm::dvec3 origin =
        points.empty() ? glm::dvec3(0.0) : glm::dvec3((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, low.z);
    city.origin_site = origin;
    city.points = std::move(points);
    if (crs.empty()) {
        for (glm::dvec3& point : city.points)
            point -= origin;
        return city;
    }
    const auto transform = GeodeticTransform::make(crs);
    if (!transform || transform->kind() == CrsKind::kNone)
        return lod::Error{path + ": referenceSystem " + crs +
                          " is unknown, expected an EPSG code of a place on the Earth"};
    std::vector<glm::dvec2> plane = {glm::dvec2(origin)};
    for (const glm::dvec3& point : city.points)
        plane.emplace_back(point);
    transform->degrees_from_crs(plane);
    const WorldFrame world;
    const auto world_at = [&](size_t i, double height_m) {
        return world.world_from_site({plane[i].x, plane[i].y, height_m});
    };
    city.origin_site = {plane[0], origin.z};
    city.is_on_earth = true;
    const glm::dvec3 origin_world = world_at(0, origin.z);
    const glm::dmat3 enu_from_world = glm::transpose(world.world_from_enu(origin_world));
    for (size_t i = 0; i < city.points.size(); ++i) {
        if (!std::isfinite(plane[i + 1].x) || !std::isfinite(plane[i + 1].y))
            return lod::Error{path + ": vertex " + std::to_string(i) + " is outside " + crs +
                              ", expected a place on the Earth"};
        city.points[i] = enu_from_world * (world_at(i + 1, city.points[i].z) - origin_world);
    }
    return city;
}

/// Wall and roof by type: what faces up takes the second.
struct TypeColours {
    std::string_view type;
    glm::u8vec3 side, top;
};
constexpr TypeColours kColours[] = {{"Building", {214, 200, 178}, {168, 112, 88}},
                                    {"Bridge", {176, 172, 166}, {150, 148, 144}},
                                    {"Tunnel", {150, 148, 146}, {150, 148, 146}},
                                    {"Road", {112, 112, 116}, {112, 112, 116}},
                                    {"Railway", {124, 116, 108}, {124, 116, 108}},
                                    {"PlantCover", {92, 122, 66}, {104, 136, 74}},
                                    {"SolitaryVegetation", {84, 114, 60}, {92, 126, 66}},
                                    {"LandUse", {150, 158, 116}, {150, 158, 116}},
                                    {"Water", {92, 124, 150}, {92, 124, 150}},
                                    {"", {186, 182, 174}, {176, 172, 164}}};

const TypeColours& colours_of(const std::string& type) {
    return *std::find_if(std::begin(kColours), std::end(kColours),
                         [&](const TypeColours& entry) { return type.starts_with(entry.type); });
}

/// Appends the surfaces of one city object to a mesh.
class SurfaceReader {
  public:
    SurfaceReader(const City& city, CityJsonStats& stats)
        : city_(city), stats_(stats), context_(make_geos_context()) {}

    /// Begins an object whose frame has its origin at its first point.
    void begin(const TypeColours& colours) {
        colours_ = &colours;
        mesh_ = {};
        has_origin_ = false;
    }
    TimedMesh take_mesh() { return std::move(mesh_); }
    const glm::dvec3& origin() const { return origin_; }

    /// Boundaries nested `depth` levels above a surface. @returns false when something is no index
    bool append(const Json& boundaries, int depth) {
        if (!boundaries.is_array()) return false;
        if (depth == 0) return append_surface(boundaries);
        return std::all_of(boundaries.begin(), boundaries.end(),
                           [&](const Json& part) { return append(part, depth - 1); });
    }

  private:
    /// A surface: rings of indices, the outer first.
    bool append_surface(const Json& rings) {
        std::vector<std::vector<glm::dvec3>> loops;
        for (const Json& ring : rings) {
            if (!ring.is_array()) return false;
            std::vector<glm::dvec3>& loop = loops.emplace_back();
            for (const Json& index : ring) {
                if (!index.is_number_unsigned() || index.get<uint64_t>() >= city_.points.size()) return false;
                loop.push_back(city_.points[index.get<uint64_t>()]);
            }
        }
        if (loops.empty()) return true;
        ++stats_.surfaces;
        if (!has_origin_ && !loops[0].empty()) {
            origin_ = loops[0][0];
            has_origin_ = true;
        }
        fill(loops);
        return true;
    }

    void fill(const std::vector<std::vector<glm::dvec3>>& loops) {
        glm::dvec3 area(0.0);  // Newell's
        for (size_t i = 1; i + 1 < loops[0].size(); ++i)
            area += glm::cross(loops[0][i] - loops[0][0], loops[0][i + 1] - loops[0][0]);
        if (!(glm::length(area) > 1e-9)) {
            ++stats_.without_area;
            return;
        }
        const glm::dvec3 normal = glm::normalize(area);
        const auto first = static_cast<uint32_t>(mesh_.positions.size());
        for (const auto& loop : loops) {
            for (const glm::dvec3& point : loop) {
                mesh_.positions.emplace_back(point - origin_);
                mesh_.normals.emplace_back(normal);
                mesh_.colours.emplace_back(normal.z > 0.5 ? colours_->top : colours_->side, uint8_t{255});
            }
        }
        for (const auto& [a, b, c] : triangles_of(loops, normal))
            mesh_.triangles.push_back({first + a, first + b, first + c});
    }

    Triangles triangles_of(const std::vector<std::vector<glm::dvec3>>& loops, const glm::dvec3& normal) {
        if (loops.size() == 1 && loops[0].size() == 3) return {{0, 1, 2}};
        const glm::dvec3 aside = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        const glm::dvec3 u = glm::normalize(glm::cross(aside, normal)), v = glm::cross(normal, u);
        RingPolygon polygon;
        for (const auto& loop : loops) {
            std::vector<glm::dvec2>& ring = polygon.rings.emplace_back();
            for (const glm::dvec3& point : loop)
                ring.emplace_back(glm::dot(point - loops[0][0], u), glm::dot(point - loops[0][0], v));
        }
        const bool has_rings = std::all_of(polygon.rings.begin(), polygon.rings.end(),
                                           [](const auto& ring) { return ring.size() >= 3; });
        Triangles triangles = has_rings ? triangulate(context_.get(), polygon) : Triangles{};
        if (!triangles.empty()) return triangles;
        ++stats_.not_triangulated;
        for (uint32_t i = 1; i + 1 < loops[0].size(); ++i)
            triangles.push_back({0, i, i + 1});
        return triangles;
    }

    const City& city_;
    CityJsonStats& stats_;
    GeosContextPtr context_;
    const TypeColours* colours_ = nullptr;
    TimedMesh mesh_;
    glm::dvec3 origin_{0.0};
    bool has_origin_ = false;
};

/// How deep a geometry's boundaries are above its surfaces; 0: not known here.
int depth_of(const Json& geometry) {
    const Json& type = member(geometry, "type");
    if (type == "MultiSurface" || type == "CompositeSurface") return 1;
    if (type == "Solid") return 2;
    if (type == "MultiSolid" || type == "CompositeSolid") return 3;
    return 0;
}

/// "2.2", or 2 in older files.
double lod_of(const Json& geometry) {
    const Json& lod = member(geometry, "lod");
    if (lod.is_number()) return lod.get<double>();
    if (!lod.is_string()) return 0.0;
    const std::string text = lod.get<std::string>();
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// The known geometry of the highest lod; the first of equal ones; null: none.
const Json& best_geometry(const Json& object) {
    const Json* best = &kNothing;
    const Json& geometries = member(object, "geometry");
    if (!geometries.is_array()) return kNothing;
    for (const Json& geometry : geometries) {
        if (depth_of(geometry) > 0 && (best->is_null() || lod_of(geometry) > lod_of(*best))) best = &geometry;
    }
    return *best;
}

}  // namespace

bool is_city_json(const std::string& path) {
    constexpr std::streamoff kPeek = 4096;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file.tellg();
    for (const std::streamoff at : {std::streamoff{0}, std::max(std::streamoff{0}, size - kPeek)}) {
        std::string text(static_cast<size_t>(std::clamp(size, std::streamoff{0}, kPeek)), ' ');
        file.seekg(at);
        file.read(text.data(), static_cast<std::streamsize>(text.size()));
        if (text.find("\"CityJSON\"") != std::string::npos) return true;
    }
    return false;
}

lod::Result<SourceScene> read_city_json(const std::string& path, CityJsonStats* stats) {
    const auto bytes = read_file(path, kMaxBytes);
    if (!bytes) return bytes.error();
    const Json root = Json::parse(bytes->begin(), bytes->end(), nullptr, false);
    if (root.is_discarded())
        return lod::Error{path + ": no whole JSON, expected a CityJSON file that is not cut short"};
    if (member(root, "type") != "CityJSON")
        return lod::Error{path + ": no CityJSON, expected \"type\": \"CityJSON\""};
    auto points = read_vertices(root, path);
    if (!points) return points.error();
    const auto city = place_city(std::move(*points), crs_of(root), path);
    if (!city) return city.error();
    const Json& objects = member(root, "CityObjects");
    if (!objects.is_object()) return lod::Error{path + ": no CityObjects, expected a CityJSON file"};

    CityJsonStats met;
    SourceScene scene;
    scene.origin_site = city->origin_site;
    scene.is_on_earth = city->is_on_earth;
    SurfaceReader reader(*city, met);
    for (const auto& [id, object] : objects.items()) {
        const Json& geometry = best_geometry(object);
        const Json& type = member(object, "type");
        reader.begin(colours_of(type.is_string() ? type.get<std::string>() : std::string()));
        if (!geometry.is_null() && !reader.append(member(geometry, "boundaries"), depth_of(geometry)))
            return lod::Error{path + ": '" + id + "' has boundaries that are no indices of vertices"};
        TimedMesh mesh = reader.take_mesh();
        if (mesh.triangles.empty()) {
            ++met.without_geometry;
            continue;
        }
        KeyFrame place;
        place.position = reader.origin();
        scene.objects.push_back({id, static_cast<uint32_t>(scene.meshes.size()), {}, {place}});
        scene.meshes.push_back(std::move(mesh));
    }
    if (stats != nullptr) *stats = met;
    return scene;
}

}  // namespace data
