#include "objects/buildings.h"

#include <algorithm>
#include <limits>

#include "lod/base/check.h"
#include "objects/building_colours.h"
#include "objects/building_mesh.h"
#include "objects/hilbert.h"

namespace objects {

namespace {

/// A footprint's place on the Hilbert curve over all of them; ties go by index.
struct Ordered {
    uint32_t curve = 0;
    uint32_t footprint = 0;

    bool operator<(const Ordered& other) const {
        return curve != other.curve ? curve < other.curve : footprint < other.footprint;
    }
};

glm::dvec2 middle_of(const data::Footprint& footprint) {
    glm::dvec2 sum(0.0);
    for (const glm::dvec2& point : footprint.rings[0])
        sum += point;
    return sum / static_cast<double>(footprint.rings[0].size());
}

std::vector<Ordered> hilbert_order(const std::vector<data::Footprint>& buildings) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const data::Footprint& building : buildings) {
        low = glm::min(low, middle_of(building));
        high = glm::max(high, middle_of(building));
    }
    const double extent = std::max({high.x - low.x, high.y - low.y, std::numeric_limits<double>::min()});
    std::vector<Ordered> order;
    order.reserve(buildings.size());
    for (const data::Footprint& building : buildings) {
        const glm::dvec2 cell = (middle_of(building) - low) / extent * 65535.0;
        order.push_back({hilbert_index(static_cast<uint16_t>(cell.x), static_cast<uint16_t>(cell.y)),
                         static_cast<uint32_t>(order.size())});
    }
    std::sort(order.begin(), order.end());
    return order;
}

void append_to_cells(const BuildingMesh& mesh, uint32_t triangles_per_cell,
                     std::vector<lod::RigidPart>& cells) {
    const size_t limit = 3 * static_cast<size_t>(triangles_per_cell);
    if (cells.empty() || cells.back().indices.size() + mesh.indices.size() > limit) cells.emplace_back();
    lod::RigidPart& cell = cells.back();
    const uint32_t first = static_cast<uint32_t>(cell.vertices.size());
    cell.vertices.insert(cell.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (uint32_t index : mesh.indices)
        cell.indices.push_back(first + index);
}

}  // namespace

Buildings build_buildings(const data::Footprints& footprints, const data::HeightGrid* ground,
                          const data::WorldFrame& world, const BuildingOptions& options) {
    Buildings buildings;
    const Ground stands_on{ground, world};
    BuildingMesh mesh;
    for (const Ordered& next : hilbert_order(footprints.buildings)) {
        const data::Footprint& footprint = footprints.buildings[next.footprint];
        const BuildingColours colours =
            building_colours(options.colour_seed, footprint.id, footprint.height_m);
        if (!mesh_building(stands_on, footprint, colours, mesh)) {
            ++buildings.off_terrain;
            continue;
        }
        append_to_cells(mesh, options.triangles_per_cell, buildings.parts);
        const auto count = static_cast<uint32_t>(mesh.vertices.size());
        buildings.sites.push_back({mesh.base_world, mesh.ground.lowest_m, mesh.ground.highest_m,
                                   next.footprint, static_cast<uint32_t>(buildings.parts.size() - 1),
                                   static_cast<uint32_t>(buildings.parts.back().vertices.size()) - count,
                                   count});
    }
    return buildings;
}

data::SampleRange ground_under(const data::Footprint& footprint, const data::HeightGrid& ground) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const std::vector<glm::dvec2>& ring : footprint.rings) {
        for (const glm::dvec2& site : ring) {
            const glm::dvec2 at = ground.frame.grid_from_site({site.x, site.y, 0.0});
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    }
    const glm::dvec2 last(ground.width - 1, ground.height - 1);
    low = glm::max(glm::floor(low), glm::dvec2(0.0));
    high = glm::min(glm::ceil(high), last);
    if (!(low.x <= high.x && low.y <= high.y)) return {};
    return {glm::ivec2(low), glm::ivec2(high)};
}

void rebuild_building(const data::Footprint& footprint, const Ground& ground, const BuildingOptions& options,
                      BuildingSite& site, std::vector<lod::Vertex>& vertices) {
    BuildingMesh mesh;
    const BuildingColours colours = building_colours(options.colour_seed, footprint.id, footprint.height_m);
    CHECK(mesh_building(ground, footprint, colours, mesh) && mesh.vertices.size() == site.vertex_count);
    site.base_world = mesh.base_world;
    site.lowest_ground_m = mesh.ground.lowest_m;
    site.highest_ground_m = mesh.ground.highest_m;
    vertices = std::move(mesh.vertices);
}

}  // namespace objects
