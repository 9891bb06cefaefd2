#include "sim/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numbers>

#include "data/ground_height.h"
#include "data/streets.h"
#include "objects/buildings.h"
#include "sim/cluster_site.h"
#include "sim/ground_texture.h"
#include "sim/paged_terrain.h"
#include "sim/progress.h"
#include "sim/sunlight.h"
#include "sim/world_models.h"
#include "terrain/roam_front.h"

namespace sim {
namespace {

constexpr int kMaxTexture_px = 8192;

terrain::RoamOptions roam_options(const WorldOptions& options) {
    terrain::RoamOptions roam;
    roam.tolerance_px = options.tolerance_px;
    roam.threads = options.threads;
    roam.batch = options.batch;
    roam.glide_s = options.batch == 0 ? options.glide_s : 0.0;
    // What glides back is drawn beyond the budget.
    roam.reserve_triangles = options.reserve_triangles * 5 / 4;
    return roam;
}

lod::Result<lod::Ok> build_paged_terrain(World& world, const WorldOptions& options) {
    auto paged = open_paged_terrain(*world.scene.terrain, roam_options(options), options.waits_for_pages);
    if (!paged) return paged.error();
    world.ground = std::make_unique<data::HeightGrid>(std::move(paged->ground.grid));
    world.ground_stride = paged->ground.stride;
    world.frame = world.ground->frame.world();
    world.terrain = std::move(paged->front);
    return lod::Ok{};
}

lod::Result<lod::Ok> build_terrain(World& world, const WorldOptions& options) {
    const TerrainSource& source = *world.scene.terrain;
    if (names_store(source)) {
        if (!world.scene.edits.empty()) {
            return lod::Error{
                fmt::format("{}:{}: [[edits]] of a terrain store, which is only read; expected rasters as "
                            "[terrain] sources",
                            world.scene.file, world.scene.edits.front().line)};
        }
        return build_paged_terrain(world, options);
    }
    if (!world.scene.edits.empty() && options.batch > 0) {
        return lod::Error{fmt::format(
            "{}:{}: [[edits]] with --batch {}; expected 0: leaves of many triangles do not change",
            world.scene.file, world.scene.edits.front().line, options.batch)};
    }
    const Stopwatch watch;
    data::HeightGridOptions reading;
    reading.voids = source.voids;
    lod::Result<data::HeightGrid> grid = data::read_height_grid(source.sources, reading);
    if (!grid) return grid.error();
    world.ground = std::make_unique<data::HeightGrid>(std::move(*grid));
    world.frame = world.ground->frame.world();
    const double reading_s = watch.seconds();

    const Stopwatch errors;
    terrain::RoamOptions roam = roam_options(options);
    const auto side =
        std::bit_ceil(static_cast<uint64_t>(std::max(world.ground->width, world.ground->height)));
    roam.reserve_triangles = std::min(roam.reserve_triangles, 2 * side * side);  // it never has more
    world.terrain = terrain::make_roam_front(*world.ground, roam);
    const data::HeightGrid& ground = *world.ground;
    const auto voids = std::count(ground.is_void.begin(), ground.is_void.end(), uint8_t{1});
    say_progress(fmt::format(
        "terrain: {} x {} samples, {:.0f} to {:.0f} m, {} voids, read in {:.1f} s, errors in {:.1f} s",
        ground.width, ground.height, ground.min_m, ground.max_m, voids, reading_s, errors.seconds()));
    return lod::Ok{};
}

/// Of all sources of buildings; only for the picture.
lod::Result<std::vector<data::Street>> read_all_streets(const World& world) {
    std::vector<data::Street> all;
    for (const BuildingSource& source : world.scene.buildings) {
        lod::Result<std::vector<data::Street>> streets = data::read_streets(source.source, world.frame);
        if (!streets) return streets.error();
        all.insert(all.end(), std::make_move_iterator(streets->begin()),
                   std::make_move_iterator(streets->end()));
    }
    return all;
}

lod::Result<lod::Ok> plan_edits(World& world, const GroundPaint* paint, unsigned threads) {
    if (world.scene.edits.empty()) return lod::Ok{};
    const Stopwatch watch;
    lod::Result<ReliefTimeline> relief = plan_relief(world.scene, *world.ground, paint, threads);
    if (!relief) return relief.error();
    world.relief = std::move(*relief);
    say_progress(fmt::format("edits: {} made ready in {:.1f} s", world.relief.edits.size(), watch.seconds()));
    return lod::Ok{};
}

lod::Result<lod::Ok> paint_terrain(World& world, const WorldOptions& options) {
    const Stopwatch watch;
    const lod::Result<std::vector<data::Street>> streets = read_all_streets(world);
    if (!streets) return streets.error();
    data::Image imagery;
    const TerrainSource& source = *world.scene.terrain;
    if (!source.imagery.empty()) {
        lod::Result<data::Image> image = data::read_imagery(source.imagery, *world.ground, kMaxTexture_px);
        if (!image) return image.error();
        imagery = std::move(*image);
    }
    GroundTextureOptions painting;
    painting.max_px = kMaxTexture_px;
    painting.threads = options.threads;
    painting.streets = *streets;
    world.ground_colours = paint_ground(*world.ground, imagery, painting);
    const GroundPaint paint{imagery, painting, world.ground_colours};
    if (auto planned = plan_edits(world, &paint, options.threads); !planned) return planned.error();
    say_progress(fmt::format("ground: {} x {} texels with {} streets painted in {:.1f} s",
                             world.ground_colours.width, world.ground_colours.height, streets->size(),
                             watch.seconds()));
    return lod::Ok{};
}

void find_ground(StandingBuildings& buildings, const data::HeightGrid& ground) {
    buildings.ground.reserve(buildings.sites.size());
    for (const objects::BuildingSite& site : buildings.sites) {
        buildings.ground.push_back(
            objects::ground_under(buildings.footprints.buildings[site.footprint], ground));
    }
}

lod::Result<lod::Ok> add_buildings(World& world, const BuildingSource& source, ModelParts& objects) {
    const Stopwatch watch;
    data::FootprintOptions reading;
    reading.default_height_m = source.default_height_m;
    lod::Result<data::Footprints> footprints = data::read_footprints(source.source, world.frame, reading);
    if (!footprints) return footprints.error();
    objects::Buildings built = objects::build_buildings(*footprints, world.ground.get(), world.frame, {});
    const auto first_part = static_cast<uint32_t>(objects.parts.size());
    const size_t first_base = world.buildings.size();
    for (lod::RigidPart& part : built.parts)
        objects.parts.push_back(std::move(part));
    for (const objects::BuildingSite& site : built.sites)
        world.buildings.push_back(site.base_world);
    const data::FootprintStats stats = footprints->stats;
    if (stats.skipped + built.off_terrain > 0) {
        world.notes.push_back(
            fmt::format("{}: {} buildings are beyond repair and {} off the terrain, not built", source.source,
                        stats.skipped, built.off_terrain));
    }
    say_progress(fmt::format(
        "buildings: {} of {} built ({} repaired, {} skipped, {} off the terrain; {} heights by default) "
        "in {:.1f} s",
        built.sites.size(), stats.read, stats.repaired, stats.skipped, built.off_terrain, stats.by_default,
        watch.seconds()));
    if (!world.scene.edits.empty()) {
        world.standing_buildings.push_back(
            {std::move(*footprints), std::move(built.sites), {}, first_part, first_base});
        find_ground(world.standing_buildings.back(), *world.ground);
    }
    return lod::Ok{};
}

lod::Result<lod::Ok> build_objects(World& world, const WorldOptions& options) {
    const Scene& scene = world.scene;
    if (scene.buildings.empty() && scene.models.empty()) return lod::Ok{};
    SceneModels objects;
    objects.rigid.bodies.emplace_back();  // the world itself: buildings stand in it
    for (const BuildingSource& source : scene.buildings) {
        if (auto added = add_buildings(world, source, objects.rigid); !added) return added.error();
    }
    if (auto added = add_models(world, options, objects); !added) return added.error();
    ModelParts& rigid = objects.rigid;
    world.item_count += static_cast<uint32_t>(rigid.parts.size());
    if (!rigid.parts.empty()) {
        world.objects = std::make_unique<lod::RigidFront>(lod::Module::kObjects, std::move(rigid.parts),
                                                          std::move(rigid.bodies));
    }
    return lod::Ok{};
}

/// Buildings, models and scenes of objects to the ground as it is now.
void settle_objects(World& world, const data::SampleRange& changed) {
    const objects::Ground ground{world.ground.get(), world.frame};
    std::vector<lod::Vertex> vertices;
    for (StandingBuildings& standing : world.standing_buildings) {
        for (size_t i = 0; i < standing.sites.size(); ++i) {
            if (data::common(standing.ground[i], changed).is_empty()) continue;
            objects::BuildingSite& site = standing.sites[i];
            objects::rebuild_building(standing.footprints.buildings[site.footprint], ground, {}, site,
                                      vertices);
            world.objects->rewrite(standing.first_part + site.part, site.first_vertex, vertices);
            world.buildings[standing.first_base + i] = site.base_world;
        }
    }
    for (const StandingModel& model : world.standing_models) {
        const lod::BodyPose pose = standing_pose(world, model.source);
        if (model.adapts) {
            world.models_rig.poses[model.body] = pose;
        } else {
            world.objects->set_pose(model.body, pose);
        }
    }
    if (world.models) pose_bodies(world.models_rig, glm::dmat3(1.0), glm::dvec3(0.0), *world.models);
    for (size_t i = 0; i < world.sites.size(); ++i) {
        // They agreed when the world was built.
        if (const auto place = place_of_site(world.scene.objects[i], world.sites[i]->tree(), world))
            world.sites[i]->stand_at(*place);
    }
}

/// The place whose east, north and up the sun's direction is given in.
glm::dvec3 middle_of(const World& world) {
    if (!world.ground) return world.frame.world_from_site(world.scene.start.site);
    const data::HeightGrid& ground = *world.ground;
    return world.frame.world_from_site(
        ground.frame.site_from_grid((ground.width - 1) / 2.0, (ground.height - 1) / 2.0));
}

}  // namespace

lod::Result<std::unique_ptr<World>> build_world(const Scene& scene, const WorldOptions& options) {
    auto world = std::make_unique<World>();
    world->scene = scene;
    if (scene.terrain) {
        if (auto built = build_terrain(*world, options); !built) return built.error();
    }
    if (auto built = build_sites(*world); !built) return built.error();
    // Before the slow parts: a path that makes no sense is told at once.
    auto eyepoint =
        make_eyepoint(world->scene, options.trajectory, world->frame, world->ground.get(), world->notes);
    if (!eyepoint) return eyepoint.error();
    world->eyepoint = std::move(*eyepoint);
    if (auto built = build_objects(*world, options); !built) return built.error();
    if (auto built = build_instruments(*world, options); !built) return built.error();
    if (scene.terrain) {
        auto painted = options.has_picture ? paint_terrain(*world, options)
                                           : plan_edits(*world, nullptr, options.threads);
        if (!painted) return painted.error();
    }
    world->sun_world = world->frame.world_from_enu(middle_of(*world)) * kSunEnu;
    for (const std::string& note : world->notes)
        say_note(note);
    return world;
}

std::vector<const TimedEdit*> bring_relief_to(World& world, double time_s) {
    std::vector<const TimedEdit*> changed;
    const size_t due = edits_at(world.relief, time_s);
    while (world.relief.in_force != due) {
        const bool forward = world.relief.in_force < due;
        const TimedEdit& edit = step_relief(world.relief, *world.ground, forward);
        world.terrain->edit({*world.ground, world.relief.extremes, edit.block.range});
        settle_objects(world, edit.block.range);
        if (world.ground_colours.width > 0)
            put_texels(forward ? edit.colours : edit.colours_before, world.ground_colours);
        changed.push_back(&edit);
    }
    return changed;
}

std::vector<WorldFront> fronts_of(const World& world) {
    std::vector<WorldFront> fronts;
    if (world.terrain) fronts.push_back({world.terrain.get(), lod::Module::kTerrain, true, false});
    if (world.objects) fronts.push_back({world.objects.get(), lod::Module::kObjects, false, false});
    for (const auto& site : world.sites)
        fronts.push_back({site.get(), lod::Module::kObjects, true, true});
    if (world.models) fronts.push_back({world.models.get(), lod::Module::kObjects, true, false});
    if (world.instruments)
        fronts.push_back({world.instruments.get(), lod::Module::kInstruments, false, false});
    if (world.panel) fronts.push_back({world.panel.get(), lod::Module::kInstruments, true, false});
    return fronts;
}

double ground_height_m(const World& world, const data::SitePoint& site) {
    if (!world.ground) return 0.0;
    const data::GroundHeight ground = data::ground_height(*world.ground, site);
    return ground.valid ? ground.height_m : 0.0;
}

Signals signals_of(const World& world, const EyeState& state, double time_s) {
    constexpr double kDegPerRad = 180.0 / std::numbers::pi;
    double heading_deg = std::fmod(state.heading_rad * kDegPerRad, 360.0);
    if (heading_deg < 0.0) heading_deg += 360.0;
    return {{state.site.height_m, state.site.height_m - ground_height_m(world, state.site), state.speed_mps,
             heading_deg, state.pitch_rad * kDegPerRad, state.roll_rad * kDegPerRad, state.vertical_speed_mps,
             time_s}};
}

}  // namespace sim
