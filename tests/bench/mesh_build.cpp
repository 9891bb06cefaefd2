// Building vertex hierarchies of large shapes through the library: a closed sphere of 10^6 triangles, and a relief of
// 513 x 513 heights as a mesh.
//
// Usage: mesh_build sphere|relief
// Prints one line of JSON: processor time, peak memory of the process, whether the hierarchy is valid, what it reaches.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string>

#include "lod/progressive/build_hierarchy.h"
#include "lod/progressive/hierarchy_check.h"
#include "lod/progressive/static_mesh.h"

namespace {

constexpr double kPi = 3.14159265358979323846;

void add_vertex(lod::SurfaceMesh& mesh, const glm::dvec3& place, const glm::dvec3& normal) {
    mesh.positions.emplace_back(place);
    mesh.normals.emplace_back(glm::normalize(normal));
    mesh.colours.emplace_back(uint8_t{200}, uint8_t{200}, uint8_t{200}, uint8_t{0});
}

/// Radius 1 m; two poles and `rings` circles of 2 * rings vertices: 4 * rings^2 triangles.
lod::SurfaceMesh sphere(uint32_t rings) {
    const uint32_t around = 2 * rings;
    lod::SurfaceMesh mesh;
    add_vertex(mesh, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0});
    for (uint32_t ring = 0; ring < rings; ++ring) {
        const double down = kPi * (ring + 1.0) / (rings + 1.0);
        for (uint32_t i = 0; i < around; ++i) {
            const double turn = 2.0 * kPi * i / around;
            const glm::dvec3 way(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn),
                                 std::cos(down));
            add_vertex(mesh, way, way);
        }
    }
    add_vertex(mesh, {0.0, 0.0, -1.0}, {0.0, 0.0, -1.0});
    const auto at = [&](uint32_t ring, uint32_t i) { return 1 + ring * around + i % around; };
    const uint32_t south = 1 + rings * around;
    for (uint32_t i = 0; i < around; ++i) {
        mesh.triangles.push_back({0, at(0, i), at(0, i + 1)});
        for (uint32_t ring = 0; ring + 1 < rings; ++ring) {
            mesh.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
            mesh.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
        }
        mesh.triangles.push_back({at(rings - 1, i), south, at(rings - 1, i + 1)});
    }
    return mesh;
}

/// Hills on eight octaves, 10 m spacing.
lod::SurfaceMesh relief(uint32_t side) {
    const auto height_m = [](double x, double y) {
        double sum = 0.0;
        for (int octave = 0; octave < 8; ++octave) {
            const double f = std::ldexp(1.0 / 2500.0, octave), turn = 1.3 * octave;
            sum += 40.0 / std::ldexp(1.0, octave) *
                   std::sin(2.0 * kPi * f * (x * std::cos(turn) + y * std::sin(turn))) *
                   std::cos(2.0 * kPi * f * (y * std::cos(turn) - x * std::sin(turn)));
        }
        return sum;
    };
    lod::SurfaceMesh mesh;
    for (uint32_t row = 0; row < side; ++row) {
        for (uint32_t col = 0; col < side; ++col) {
            const double x = 10.0 * col, y = 10.0 * row;
            const double slope_x = (height_m(x + 1.0, y) - height_m(x - 1.0, y)) / 2.0,
                         slope_y = (height_m(x, y + 1.0) - height_m(x, y - 1.0)) / 2.0;
            add_vertex(mesh, {x, y, height_m(x, y)}, {-slope_x, -slope_y, 1.0});
        }
    }
    for (uint32_t row = 0; row + 1 < side; ++row) {
        for (uint32_t col = 0; col + 1 < side; ++col) {
            const uint32_t a = row * side + col, b = a + 1, c = a + side, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    }
    return mesh;
}

double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024.0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string shape = argc == 2 ? argv[1] : "";
    if (shape != "sphere" && shape != "relief")
        return std::fprintf(stderr, "usage: mesh_build sphere|relief\n"), 2;
    const lod::SurfaceMesh mesh = shape == "sphere" ? sphere(500) : relief(513);
    const double source_mb = peak_mb();
    const std::clock_t begin = std::clock();
    lod::MeshReport met;
    const auto hierarchy = lod::build_hierarchy(mesh, {}, met);
    const double spent_s = double(std::clock() - begin) / CLOCKS_PER_SEC;
    if (!hierarchy) return std::fprintf(stderr, "%s\n", hierarchy.message().c_str()), 1;
    const lod::ScaledHierarchy whole{&*hierarchy, 1.0};
    const lod::StaticMesh coarse = lod::meshes_of_size({&whole, 1}, mesh.triangles.size() / 16)[0];
    const std::string fault = lod::fault_of(*hierarchy);
    const nlohmann::json report{{"shape", shape},
                                {"triangles", mesh.triangles.size()},
                                {"border_edges", met.border_edges},
                                {"build_s", spent_s},
                                {"source_mb", source_mb},
                                {"peak_mb", peak_mb()},
                                {"fault", fault},
                                {"coarse_triangles", coarse.triangles.size()},
                                {"coarse_error_m", coarse.error_m},
                                {"coarse_flipped", lod::count_flipped(*hierarchy, coarse)},
                                {"levels", lod::count_levels(*hierarchy)}};
    std::printf("%s\n", report.dump().c_str());
    return fault.empty() ? 0 : 1;
}
