#include "sim/command_terrain.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "data/height_grid.h"
#include "data/height_raster.h"
#include "data/raster_place.h"
#include "sim/ply_writer.h"
#include "sim/relief_source.h"
#include "sim/whole_file.h"
#include "terrain/extract.h"
#include "terrain/store/store_format.h"

namespace sim {
namespace {

/// Where the file's own samples lie; a store's are the grid's.
lod::Result<data::RasterPlace> place_of(const std::string& source, const data::HeightGrid& grid) {
    if (terrain::is_store(source)) {
        return data::RasterPlace::make(grid.frame.geo_transform(), grid.frame.crs_wkt(), grid.width,
                                       grid.height);
    }
    const auto raster = data::read_height_raster(source, true);
    if (!raster) return raster.error();
    return data::RasterPlace::make(raster->geo_transform, raster->crs_wkt, raster->width, raster->height);
}

/// CRS x and y of the mesh's vertices. The grid may lie turned against its file: places go by way of the site to the
/// file's own sample, whose CRS position is exact.
lod::Result<std::vector<glm::dvec2>> crs_positions(const std::string& source, const data::HeightGrid& grid,
                                                   const terrain::ExtractedMesh& mesh) {
    const auto place = place_of(source, grid);
    if (!place) return place.error();
    std::vector<glm::dvec2> points;
    points.reserve(mesh.vertices.size());
    for (const terrain::ExtractedMesh::Vertex& vertex : mesh.vertices) {
        const data::SitePoint site = grid.frame.site_from_grid(vertex.col, vertex.row);
        points.emplace_back(site.x, site.y);
    }
    place->grid_from_sites(points);
    for (glm::dvec2& point : points)
        point = place->affine().crs_from_grid(glm::round(point));
    return points;
}

}  // namespace

void add_extract(CLI::App& app, ExtractArguments& arguments) {
    app.add_option("dem", arguments.source, "raster of heights, anything GDAL opens, or a terrain store")
        ->required()
        ->type_name("DEM");
    app.add_option("--max-error", arguments.max_error_m,
                   "no sample is farther from the mesh, vertically, m; 0: all of it")
        ->required()
        ->check(CLI::Range(0.0, 1e5))
        ->type_name("M");
    app.add_option("--out", arguments.out, "file to write, binary PLY")->required()->type_name("F.ply");
    app.add_option("--voids", arguments.voids, "samples without a height become a hole, or are filled")
        ->check(CLI::IsMember({"hole", "fill"}))
        ->capture_default_str();
}

lod::Result<lod::Ok> run_extract(const ExtractArguments& arguments) {
    if (auto writable = check_writable(arguments.out); !writable) return writable.error();
    data::HeightGridOptions reading;
    reading.voids = arguments.voids == "hole" ? data::VoidPolicy::kHole : data::VoidPolicy::kFill;
    const auto grid = read_relief({arguments.source}, reading);
    if (!grid) return grid.error();
    const terrain::ExtractedMesh mesh = terrain::extract(*grid, arguments.max_error_m);
    const auto positions = crs_positions(arguments.source, *grid, mesh);
    if (!positions) return positions.error();

    PlyMesh ply;
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        ply.vertices.emplace_back((*positions)[i], static_cast<double>(mesh.vertices[i].height_m));
    }
    ply.faces = mesh.triangles;
    ply.module.assign(mesh.triangles.size(), 0);
    if (auto written = write_ply(arguments.out, ply); !written) return written.error();
    const nlohmann::json json = {{"triangles", mesh.triangles.size()},
                                 {"vertices", mesh.vertices.size()},
                                 {"max_error_m", mesh.max_error_m}};
    std::printf("%s\n", json.dump().c_str());
    return lod::Ok{};
}

}  // namespace sim
