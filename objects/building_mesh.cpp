#include "objects/building_mesh.h"

#include <algorithm>

namespace objects {

namespace {

constexpr double kRoofAboveHighestM = 2.0;  // so that a roof never meets the slope behind the house

/// What all walls of a building share.
struct Shell {
    const Ground& ground;
    const BuildingColours& colours;
    double roof_m = 0.0, floor_m = 0.0;
    bool hangs_free = false;
    glm::dvec3 up_world{0.0};
};

uint32_t append(BuildingMesh& mesh, const lod::Vertex& vertex) {
    mesh.vertices.push_back(vertex);
    return static_cast<uint32_t>(mesh.vertices.size() - 1);
}

/// The lower chain of a wall: its feet on the ground, or two corners at the height of a free floor.
uint32_t append_lower_chain(const Shell& shell, std::span<const Foot> feet, const glm::vec3& normal,
                            BuildingMesh& out) {
    const uint32_t first = static_cast<uint32_t>(out.vertices.size());
    if (shell.hangs_free) {
        for (const Foot* foot : {&feet.front(), &feet.back()}) {
            const glm::dvec3 at = world_at(shell.ground, foot->plane, shell.floor_m);
            append(out, lod::make_vertex(at, normal, shell.colours.wall, lod::Material::kWall));
        }
        return first;
    }
    for (const Foot& foot : feet) {
        const glm::dvec3 at = world_at(shell.ground, foot.plane, foot.height_m);
        append(out, lod::make_vertex(at, normal, shell.colours.foot, lod::Material::kWallFoot));
    }
    return first;
}

void append_wall(const Shell& shell, std::span<const Foot> feet, BuildingMesh& out) {
    const glm::dvec3 left = world_at(shell.ground, feet.front().plane, shell.roof_m);
    const glm::dvec3 right = world_at(shell.ground, feet.back().plane, shell.roof_m);
    const glm::vec3 normal(glm::normalize(glm::cross(right - left, shell.up_world)));
    const uint32_t lower = append_lower_chain(shell, feet, normal, out);
    const uint32_t lower_end = static_cast<uint32_t>(out.vertices.size()) - 1;
    const uint32_t top_left =
        append(out, lod::make_vertex(left, normal, shell.colours.wall, lod::Material::kWall));
    const uint32_t top_right =
        append(out, lod::make_vertex(right, normal, shell.colours.wall, lod::Material::kWall));
    for (uint32_t foot = lower; foot < lower_end; ++foot)
        out.indices.insert(out.indices.end(), {foot, foot + 1, top_left});
    out.indices.insert(out.indices.end(), {lower_end, top_right, top_left});
}

/// The footprint's triangles at one height; `is_underside` turns them over.
void append_slab(const Shell& shell, const data::Footprint& footprint, std::span<const Footing> rings,
                 bool is_underside, BuildingMesh& out) {
    const uint32_t first = static_cast<uint32_t>(out.vertices.size());
    const glm::vec3 normal(is_underside ? -shell.up_world : shell.up_world);
    const glm::u8vec3 colour = is_underside ? shell.colours.underside : shell.colours.roof;
    const lod::Material material = is_underside ? lod::Material::kWall : lod::Material::kRoof;
    for (const Footing& ring : rings) {
        for (size_t edge = 0; edge < ring.edges(); ++edge) {
            const Foot& corner = ring.feet[ring.first_foot[edge]];
            const double height_m = is_underside ? shell.floor_m : shell.roof_m;
            append(out, lod::make_vertex(world_at(shell.ground, corner.plane, height_m), normal, colour,
                                         material));
        }
    }
    for (const auto& [a, b, c] : footprint.triangles) {
        const uint32_t second = is_underside ? c : b, third = is_underside ? b : c;
        out.indices.insert(out.indices.end(), {first + a, first + second, first + third});
    }
}

/// Lays all rings; false when one of them leaves the ground.
bool lay_rings(const Ground& ground, const data::Footprint& footprint, std::vector<Footing>& rings,
               GroundProfile& profile) {
    rings.resize(footprint.rings.size());
    for (size_t i = 0; i < rings.size(); ++i) {
        if (!lay_ring(ground, footprint.rings[i], rings[i])) return false;
        const GroundProfile ring = profile_of(rings[i]);
        if (i == 0) profile = ring;
        profile.lowest_m = std::min(profile.lowest_m, ring.lowest_m);
        profile.highest_m = std::max(profile.highest_m, ring.highest_m);
    }
    return !rings.empty();
}

}  // namespace

bool mesh_building(const Ground& ground, const data::Footprint& footprint, const BuildingColours& colours,
                   BuildingMesh& out) {
    out.vertices.clear();
    out.indices.clear();
    std::vector<Footing> rings;
    if (!lay_rings(ground, footprint, rings, out.ground)) return false;
    const Foot& first = rings[0].feet[0];
    out.base_world = world_at(ground, first.plane, first.height_m);
    Shell shell{ground, colours};
    shell.roof_m =
        std::max(out.ground.mean_m + footprint.height_m, out.ground.highest_m + kRoofAboveHighestM);
    shell.floor_m = out.ground.mean_m + footprint.min_height_m;
    shell.hangs_free = footprint.min_height_m > 0.0;
    shell.up_world = ground.world.world_from_enu(out.base_world)[2];
    for (const Footing& ring : rings) {
        for (size_t edge = 0; edge < ring.edges(); ++edge) {
            const size_t begin = ring.first_foot[edge], end = ring.first_foot[edge + 1];
            append_wall(shell, std::span(ring.feet).subspan(begin, end - begin + 1), out);
        }
    }
    append_slab(shell, footprint, rings, false, out);
    if (shell.hangs_free) append_slab(shell, footprint, rings, true, out);
    return true;
}

}  // namespace objects
