#include "sim/command_query.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "data/ground_query.h"
#include "data/line_of_sight.h"
#include "sim/command_values.h"
#include "sim/query_lines.h"
#include "sim/relief_source.h"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(data::GroundKind kind) {
    switch (kind) {
        case data::GroundKind::kMeasured:
            return "measured";
        case data::GroundKind::kFilled:
            return "filled";
        case data::GroundKind::kVoid:
            return "void";
        case data::GroundKind::kOutside:
            break;
    }
    return "outside";
}

Json json_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json json_of(const data::SitePoint& site) {
    return {site.x, site.y, site.height_m};
}

/// The normal's parts to the east, the north and up.
glm::dvec3 enu_normal(const data::WorldFrame& frame, const data::SitePoint& site,
                      const glm::dvec3& normal_world) {
    return glm::transpose(frame.world_from_enu(frame.world_from_site(site))) * normal_world;
}

Json answer_of(const data::WorldFrame& frame, const data::SitePoint& site, const data::GroundAnswer& ground) {
    Json json = {
        {"x", site.x}, {"y", site.y}, {"valid", ground.is_valid()}, {"ground", name_of(ground.kind)}};
    if (!ground.is_valid()) return json;
    json["height_m"] = ground.height_m;
    json["normal_enu"] = json_of(enu_normal(frame, site, ground.normal_world));
    json["spacing_m"] = ground.spacing_m;
    return json;
}

Json answer_of(const data::WorldFrame& frame, const QueryLine& line, const data::Sight& sight) {
    Json json = {{"from", json_of(line.from)},
                 {"to", json_of(line.to)},
                 {"blocked", sight.is_blocked},
                 {"through_void", sight.is_through_void}};
    if (!sight.is_blocked) return json;
    json["hit"] = json_of(frame.site_from_world(sight.end_world));
    json["distance_m"] = glm::distance(frame.world_from_site(line.from), sight.end_world);
    return json;
}

/// The one question of the command line, or those of the file.
lod::Result<std::vector<QueryLine>> questions(const QueryArguments& arguments,
                                              const data::WorldFrame& frame) {
    if (arguments.from.empty()) {
        if (arguments.points == "-") return read_query_lines(std::cin, "standard input", frame);
        std::ifstream file(arguments.points);
        if (!file) return lod::Error{arguments.points + ": cannot be opened, expected a file of points"};
        return read_query_lines(file, arguments.points, frame);
    }
    const std::vector<double>&a = arguments.from, &b = arguments.to;
    const QueryLine line{{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, true, "--from, --to"};
    for (const data::SitePoint& site : {line.from, line.to}) {
        if (auto is_place = check_place(frame, site, line.where); !is_place) return is_place.error();
    }
    return std::vector<QueryLine>{line};
}

/// Ends whose heights are above the ground get heights as the source counts them.
lod::Result<lod::Ok> lift_ends(const data::HeightGrid& grid, std::vector<QueryLine>& lines) {
    for (QueryLine& line : lines) {
        if (!line.is_sight) continue;
        for (data::SitePoint* site : {&line.from, &line.to}) {
            const data::GroundHeight ground = data::ground_height(grid, *site);
            if (!ground.valid) {
                return lod::Error{
                    fmt::format("{}: no ground at {}, {}, expected some below heights above ground",
                                line.where, site->x, site->y)};
            }
            site->height_m += ground.height_m;
        }
    }
    return lod::Ok{};
}

/// One line of JSON per question, in their order.
void print_answers(const data::HeightGrid& grid, const std::vector<QueryLine>& lines, unsigned threads) {
    const data::WorldFrame& frame = grid.frame.world();
    std::vector<data::SitePoint> sites;
    std::vector<data::WorldLine> sight_lines;
    for (const QueryLine& line : lines) {
        if (line.is_sight) {
            sight_lines.push_back({frame.world_from_site(line.from), frame.world_from_site(line.to)});
        } else {
            sites.push_back(line.from);
        }
    }
    std::vector<data::GroundAnswer> ground(sites.size());
    data::ground_at_sites(grid, sites, ground, threads);
    std::vector<data::Sight> sights(sight_lines.size());
    if (!sights.empty()) {
        data::lines_of_sight(grid, data::make_height_pyramid(grid, threads), sight_lines, sights, threads);
    }
    size_t next_site = 0, next_sight = 0;
    for (const QueryLine& line : lines) {
        const Json json = line.is_sight ? answer_of(frame, line, sights[next_sight++])
                                        : answer_of(frame, line.from, ground[next_site++]);
        std::printf("%s\n", json.dump().c_str());
    }
}

}  // namespace

void add_query(CLI::App& app, QueryArguments& arguments) {
    app.add_option("dem", arguments.sources,
                   "rasters of heights, anything GDAL opens; the first listed wins; or one terrain store")
        ->required()
        ->type_name("DEM");
    CLI::Option* points =
        app.add_option(
               "--points", arguments.points,
               "file of questions, - for standard input; a line is X Y (a height: longitude and latitude in "
               "degrees, or the raster's x and y without a datum) or X Y H X Y H (a line of sight; m)")
            ->type_name("FILE")
            ->capture_default_str();
    CLI::Option* from = add_numbers(app, "--from", arguments.from, 3,
                                    "one line of sight from here; longitude, latitude, height in m")
                            ->type_name("X,Y,H")
                            ->excludes(points);
    CLI::Option* to = add_numbers(app, "--to", arguments.to, 3, "to here")->type_name("X,Y,H")->needs(from);
    from->needs(to);
    app.add_flag("--above-ground", arguments.above_ground, "heights of lines of sight count from the ground");
    app.add_option("--voids", arguments.voids, "samples without a height stay unknown, or are filled")
        ->check(CLI::IsMember({"hole", "fill"}))
        ->capture_default_str();
    add_threads(app, arguments.threads);
}

lod::Result<lod::Ok> run_query(const QueryArguments& arguments) {
    data::HeightGridOptions reading;
    reading.voids = arguments.voids == "hole" ? data::VoidPolicy::kHole : data::VoidPolicy::kFill;
    const auto grid = read_relief(arguments.sources, reading);
    if (!grid) return grid.error();
    auto lines = questions(arguments, grid->frame.world());
    if (!lines) return lines.error();
    if (arguments.above_ground) {
        if (auto lifted = lift_ends(*grid, *lines); !lifted) return lifted.error();
    }
    print_answers(*grid, *lines, arguments.threads);
    return lod::Ok{};
}

}  // namespace sim
