#include "sim/cluster_site.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/cluster_file.h"
#include "sim/progress.h"

namespace sim {
namespace {

/// Draw items a site rarely needs more of; the renderer makes room when it does.
constexpr uint32_t kUsualItems = 16384;

lod::Error disagreement(const ObjectSource& source, const World& world, const char* what) {
    return lod::Error{
        fmt::format("{}:{}: [[objects]] {} {}", world.scene.file, source.line, source.source, what)};
}

/// Columns east, north, up, turned clockwise from north.
glm::dmat3 turned(const glm::dmat3& world_from_enu, double heading_rad) {
    const double s = std::sin(heading_rad), c = std::cos(heading_rad);
    return world_from_enu *
           glm::dmat3(glm::dvec3(c, -s, 0.0), glm::dvec3(s, c, 0.0), glm::dvec3(0.0, 0.0, 1.0));
}

}  // namespace

lod::Result<objects::ScenePlace> place_of_site(const ObjectSource& source, const objects::ClusterTree& tree,
                                               const World& world) {
    const data::WorldFrame& frame = world.frame;
    objects::ScenePlace place;
    if (tree.is_on_earth) {
        if (source.site)
            return disagreement(source, world, "knows its place on the Earth, expected no position");
        if (!frame.has_datum)
            return disagreement(source, world, "lies on the Earth, expected a terrain with a datum");
        place.origin_world =
            frame.world_from_site({tree.origin_site.x, tree.origin_site.y, tree.origin_site.z});
        place.world_from_scene = frame.world_from_enu(place.origin_world);
        return place;
    }
    if (!source.site) {
        if (frame.has_datum)
            return disagreement(source, world, "has no place on the Earth, expected a position");
        place.world_from_scene = turned(glm::dmat3(1.0), source.heading_rad);
        return place;
    }
    data::SitePoint site{source.site->x, source.site->y, 0.0};
    site.height_m = ground_height_m(world, site) + source.height_m;
    place.origin_world = frame.world_from_site(site);
    place.world_from_scene = turned(frame.world_from_enu(place.origin_world), source.heading_rad);
    return place;
}

lod::Result<lod::Ok> build_sites(World& world) {
    const std::vector<ObjectSource>& sources = world.scene.objects;
    std::vector<objects::ClusterTree> trees;
    for (const ObjectSource& source : sources) {
        const Stopwatch watch;
        auto tree = read_cluster_file(source.source);
        if (!tree) return tree.error();
        say_progress(
            fmt::format("objects: {} in {} clusters, {} triangles, {:.0f} s of schedule, read in {:.1f} s",
                        tree->object_count, tree->clusters.size(), tree->indices.size() / 3, tree->end_s,
                        watch.seconds()));
        trees.push_back(std::move(*tree));
    }
    const bool is_on_earth =
        std::any_of(trees.begin(), trees.end(), [](const auto& tree) { return tree.is_on_earth; });
    if (!sources.empty() && !world.ground && !is_on_earth && world.scene.buildings.empty())
        world.frame.has_datum = false;
    for (size_t i = 0; i < trees.size(); ++i) {
        const auto place = place_of_site(sources[i], trees[i], world);
        if (!place) return place.error();
        world.item_count += std::min(2 * trees[i].object_count, kUsualItems);
        world.sites.push_back(std::make_unique<objects::ClusterFront>(std::move(trees[i]), *place));
    }
    return lod::Ok{};
}

}  // namespace sim
