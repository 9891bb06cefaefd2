#include "terrain/rivals/vdpm.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "lod/base/check.h"
#include "lod/base/hash.h"
#include "lod/progressive/decimate.h"
#include "lod/progressive/error_proof.h"
#include "lod/progressive/hierarchy_bounds.h"

namespace terrain {
namespace {

/// The frame of the mesh: its origin in the middle of the raster, its z upwards there.
lod::BodyPose level_frame(const data::HeightGrid& grid) {
    const int col = grid.width / 2, row = grid.height / 2;
    const glm::dvec3 origin = grid.frame.world_from_sample(col, row, 0.0);
    const glm::dvec3 up = glm::normalize(grid.frame.world_from_sample(col, row, 1000.0) - origin);
    const glm::dvec3 along =
        grid.frame.world_from_sample(col + (col + 1 < grid.width ? 1 : -1), row, 0.0) - origin;
    const glm::dvec3 x = glm::normalize(along - up * glm::dot(along, up));
    return {lod::BodyPose::Frame::kPlaced, glm::dmat3(x, glm::cross(up, x), up), origin};
}

/// Two triangles a cell, one colour, all normals alike: what tells vertices apart is their place alone.
lod::SurfaceMesh surface_of(const data::HeightGrid& grid, const lod::BodyPose& frame) {
    lod::SurfaceMesh mesh;
    const glm::dmat3 mesh_from_world = glm::transpose(frame.reference_from_body);
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            const double height_m = static_cast<double>(grid.at(col, row));
            mesh.positions.emplace_back(mesh_from_world *
                                        (grid.frame.world_from_sample(col, row, height_m) - frame.origin));
        }
    }
    mesh.normals.assign(mesh.positions.size(), {0.0f, 0.0f, 1.0f});
    mesh.colours.assign(mesh.positions.size(), glm::u8vec4(255));
    const auto at = [&](int col, int row) { return static_cast<uint32_t>(grid.index(col, row)); };
    for (int row = 0; row + 1 < grid.height; ++row) {
        for (int col = 0; col + 1 < grid.width; ++col) {
            // Rows run south: counter-clockwise from above. Diagonals alternate, as in ROAM's finest mesh.
            const uint32_t nw = at(col, row), ne = at(col + 1, row), sw = at(col, row + 1);
            const uint32_t se = at(col + 1, row + 1);
            const bool is_even = ((col + row) & 1) == 0;
            mesh.triangles.push_back({nw, sw, is_even ? se : ne});
            mesh.triangles.push_back({is_even ? nw : sw, se, ne});
        }
    }
    return mesh;
}

/// The steepest triangle, metres up a metre along.
double steepest(const lod::SurfaceMesh& mesh) {
    double worst = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 at(mesh.positions[a]);
        const glm::dvec3 across =
            glm::cross(glm::dvec3(mesh.positions[b]) - at, glm::dvec3(mesh.positions[c]) - at);
        worst = std::max(worst, glm::length(glm::dvec2(across)) / std::abs(across.z));
    }
    return worst;
}

struct PlaceHash {
    size_t operator()(const std::array<uint32_t, 3>& bits) const {
        return lod::mix64(lod::mix64(uint64_t{bits[0]} << 32 | bits[1]) ^ bits[2]);
    }
};
std::array<uint32_t, 3> bits_of(const glm::vec3& p) {
    return {std::bit_cast<uint32_t>(p.x), std::bit_cast<uint32_t>(p.y), std::bit_cast<uint32_t>(p.z)};
}

/// Samples of places that are some of the surface's.
std::vector<uint32_t> samples_of(std::span<const glm::vec3> places, const lod::SurfaceMesh& surface) {
    std::unordered_map<std::array<uint32_t, 3>, uint32_t, PlaceHash> sample_at;
    for (uint32_t sample = 0; sample < surface.positions.size(); ++sample)
        sample_at[bits_of(surface.positions[sample])] = sample;
    std::vector<uint32_t> samples;
    for (const glm::vec3& place : places) {
        const auto found = sample_at.find(bits_of(place));
        CHECK(found != sample_at.end());
        samples.push_back(found->second);
    }
    return samples;
}

/// The raster's corners stay, so that every front covers all of it.
void lock_corners(lod::ManifoldMesh& mesh, const data::HeightGrid& grid, const lod::SurfaceMesh& surface) {
    const std::vector<uint32_t> samples = samples_of(mesh.positions, surface);
    for (size_t leaf = 0; leaf < samples.size(); ++leaf) {
        const int col = static_cast<int>(samples[leaf]) % grid.width;
        const int row = static_cast<int>(samples[leaf]) / grid.width;
        const bool is_corner = (col == 0 || col == grid.width - 1) && (row == 0 || row == grid.height - 1);
        if (is_corner) mesh.is_locked[leaf] = 1;
    }
}

/// A hierarchy whose errors are vertical distances and none of whose triangles is ever turned over, seen from above:
/// it is built over ground pressed so flat that turning over is a turn of more than 90 degrees, and that a distance
/// between surfaces is a vertical one. A full surface no steeper than L is within d sqrt(1 + L^2) above or below
/// whatever is within d of it.
/// @param samples  [nodes] receives what each stands on
lod::VertexHierarchy flat_hierarchy(const data::HeightGrid& grid, const lod::SurfaceMesh& surface,
                                    std::vector<uint32_t>& samples) {
    constexpr double kPressedSlope = 0.25;
    const double slope = steepest(surface);
    const double pressed = std::min(1.0, kPressedSlope / std::max(slope, 1e-9));
    lod::SurfaceMesh flat = surface;
    for (glm::vec3& p : flat.positions)
        p.z = static_cast<float>(static_cast<double>(p.z) * pressed);
    lod::MeshReport report;
    lod::Result<lod::ManifoldMesh> manifold = lod::make_manifold(flat, 0.0, report);
    CHECK(manifold);  // a grid of finite heights is one
    lock_corners(*manifold, grid, flat);
    lod::DecimateOptions options;
    options.place = lod::CollapsePlace::kEnd;
    lod::ErrorProof proof(manifold->positions, manifold->triangles);
    lod::VertexHierarchy hierarchy =
        lod::decimate(*manifold, options, [&proof](const lod::CollapseStep& step) { proof.take(step); });
    hierarchy.error_m = proof.errors_m();
    samples = samples_of(hierarchy.position, flat);
    for (size_t node = 0; node < samples.size(); ++node)
        hierarchy.position[node] = surface.positions[samples[node]];
    const double upright = std::sqrt(1.0 + slope * slope * pressed * pressed) / pressed;
    for (float& error_m : hierarchy.error_m)
        error_m = static_cast<float>(static_cast<double>(error_m) * upright * (1.0 + 0x1p-20));
    lod::bound_normals(hierarchy);
    lod::bound_places(hierarchy);
    return hierarchy;
}

template <typename Element>
uint64_t bytes_of(const std::vector<Element>& elements) {
    return elements.size() * sizeof(Element);
}

/// Of the hierarchy and what a front derives from it.
uint64_t bytes_of(const lod::ProgressiveMesh& mesh) {
    const lod::VertexHierarchy& h = mesh.hierarchy;
    return bytes_of(h.position) + bytes_of(h.parent) + bytes_of(h.children) + bytes_of(h.triangles) +
           bytes_of(h.vertex_node) + bytes_of(h.normal) + bytes_of(h.colour) + bytes_of(h.triangle_vertices) +
           bytes_of(h.error_m) + bytes_of(h.centre) + bytes_of(h.radius_m) + bytes_of(h.cone_axis) +
           bytes_of(h.cone_cos) + bytes_of(mesh.last_corners) + bytes_of(mesh.last_vertices) +
           bytes_of(mesh.remover) + bytes_of(mesh.further_begin) + bytes_of(mesh.further_vertices) +
           bytes_of(mesh.bounds) + bytes_of(mesh.heads) + bytes_of(mesh.lists) + bytes_of(mesh.roots);
}

}  // namespace

Vdpm::Vdpm(const data::HeightGrid& grid, double tolerance_px) : grid_(grid) {
    CHECK(grid.height_m.size() <= kMostSamples);
    const lod::BodyPose frame = level_frame(grid);
    std::vector<uint32_t> node_samples;
    std::vector<lod::ProgressiveMesh> meshes;
    meshes.push_back(lod::make_progressive_mesh(flat_hierarchy(grid, surface_of(grid, frame), node_samples)));
    for (const lod::NodeId node : meshes[0].hierarchy.vertex_node)
        sample_of_.push_back(node_samples[node]);
    memory_bytes_ = bytes_of(meshes[0]);
    const lod::MeshPlacement placement{0, frame};
    lod::MeshOptions options;
    options.ranks = {.tolerance_px = tolerance_px, .silhouette_weight = 1.0};
    front_ = std::make_unique<lod::MeshFront>(lod::Module::kTerrain, std::move(meshes),
                                              std::span(&placement, 1), options);
}

void Vdpm::begin_frame(std::span<const lod::View> views, double time_s) {
    is_first_view_ = true;
    front_->begin_frame(views, time_s);
}

void Vdpm::place(const lod::PoolRegion& region) {
    region_ = region;
    vertices_.place();
    front_->place(region);
}

void Vdpm::emit(const lod::View& view, lod::DrawList& out) {
    mesh_list_.clear();
    front_->emit(view, mesh_list_);
    if (std::exchange(is_first_view_, false)) {
        vertices_.write(region_.first_vertex, out, [&](std::vector<lod::Vertex>& vertices) {
            for (const uint32_t sample : sample_of_) {
                vertices.push_back(ground_vertex(grid_, static_cast<int>(sample) % grid_.width,
                                                 static_cast<int>(sample) / grid_.width));
            }
        });
        out.index_writes.insert(out.index_writes.end(), mesh_list_.index_writes.begin(),
                                mesh_list_.index_writes.end());
    }
    for (lod::DrawItem item : mesh_list_.items) {
        item.instance = static_cast<uint32_t>(out.instances.size());
        out.items.push_back(item);
    }
    out.instances.push_back(
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kTerrain));
}

}  // namespace terrain
