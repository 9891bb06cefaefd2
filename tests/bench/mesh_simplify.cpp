// A static mesh of so many triangles, out of a hierarchy built once and by meshoptimizer: time, what is told, what is true.
//
// Usage: mesh_simplify MODEL TRIANGLES [REPEATS [OTHER]]
// The model's largest node. OTHER is what another program has made of it, in the same frame. Prints one line of JSON;
// times are the processor's, the least of all repeats.
#include <meshoptimizer.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "data/polygon_mesh.h"
#include "lod/progressive/build_hierarchy.h"
#include "lod/progressive/static_mesh.h"
#include "lod/surface/surface_distance.h"

namespace {

struct Surface {
    std::vector<glm::dvec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
    lod::Soup soup() const { return {points, triangles}; }
};

struct Task {
    const data::MeshNode& node;
    Surface full;
    double extent_m = 0.0;
    size_t wanted = 0;
    int repeats = 1;
};

Task make_task(const data::MeshNode& node, size_t wanted, int repeats) {
    Task task{node, {{}, node.triangles}, 0.0, wanted, repeats};
    glm::vec3 low = node.positions[0], high = low;
    for (const glm::vec3& p : node.positions) {
        task.full.points.emplace_back(p);
        low = glm::min(low, p), high = glm::max(high, p);
    }
    const glm::vec3 size = high - low;
    task.extent_m = double(std::max({size.x, size.y, size.z}));
    return task;
}

double least_s(int repeats, const std::function<void()>& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeats; ++i) {
        const std::clock_t begin = std::clock();
        work();
        least = std::min(least, double(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
}

nlohmann::json report(const Task& task, const Surface& found, double spent_s, double told_m) {
    constexpr double kSlack = 1e-5;  // of the extent
    const lod::DistanceBounds apart =
        lod::two_sided_distance(task.full.soup(), found.soup(), kSlack * task.extent_m, 1);
    return {{"triangles", found.triangles.size()},
            {"spent_s", spent_s},
            {"told_m", told_m},
            {"measured_m", apart.upper_m}};
}

nlohmann::json by_hierarchy(const Task& task) {
    const data::MeshNode& node = task.node;
    lod::MeshReport met;
    const std::clock_t begin = std::clock();
    const auto hierarchy =
        lod::build_hierarchy({node.positions, node.normals, node.colours, node.triangles}, {}, met);
    const double build_s = double(std::clock() - begin) / CLOCKS_PER_SEC;
    if (!hierarchy) return {{"failed", hierarchy.message()}};
    const lod::ScaledHierarchy whole{&*hierarchy, 1.0};
    lod::StaticMesh chosen;
    const double spent_s = least_s(task.repeats, [&] {
        chosen = lod::meshes_of_size({&whole, 1}, task.wanted)[0];
    });
    Surface found;
    for (const glm::vec3& p : hierarchy->position)
        found.points.emplace_back(p);
    const auto node_of = [&](lod::VertexId vertex) { return hierarchy->vertex_node[vertex]; };
    for (const auto& [a, b, c] : chosen.triangles)
        found.triangles.push_back({node_of(a), node_of(b), node_of(c)});
    nlohmann::json json = report(task, found, spent_s, chosen.error_m);
    json["build_s"] = build_s;
    return json;
}

/// Over places alone: breaks of normals and colours would be borders to it.
nlohmann::json by_meshoptimizer(const Task& task) {
    const std::vector<glm::vec3>& places = task.node.positions;
    std::vector<uint32_t> indices;
    for (const auto& triangle : task.node.triangles)
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    std::vector<uint32_t> same(indices.size());
    meshopt_generateShadowIndexBuffer(same.data(), indices.data(), indices.size(), places.data(),
                                      places.size(), sizeof(glm::vec3), sizeof(glm::vec3));
    std::vector<uint32_t> left(same.size());
    size_t count = 0;
    float told = 0.0f;
    const double spent_s = least_s(task.repeats, [&] {
        count = meshopt_simplify(left.data(), same.data(), same.size(), &places[0].x, places.size(),
                                 sizeof(glm::vec3), 3 * task.wanted, 1.0f, 0, &told);
    });
    Surface found{task.full.points, {}};
    for (size_t i = 0; i < count; i += 3)
        found.triangles.push_back({left[i], left[i + 1], left[i + 2]});
    const float extent_m = meshopt_simplifyScale(&places[0].x, places.size(), sizeof(glm::vec3));
    return report(task, found, spent_s, double(told * extent_m));
}

const data::MeshNode& largest_node(const data::PolygonMesh& mesh) {
    return *std::max_element(mesh.nodes.begin(), mesh.nodes.end(), [](const auto& a, const auto& b) {
        return a.triangles.size() < b.triangles.size();
    });
}

nlohmann::json by_another(const Task& task, const char* path) {
    const auto model = data::read_polygon_mesh(path);
    if (!model) return {{"failed", model.message()}};
    const data::MeshNode& node = largest_node(*model);
    nlohmann::json json =
        report(task, {{node.positions.begin(), node.positions.end()}, node.triangles}, 0.0, 0.0);
    json.erase("spent_s");
    json.erase("told_m");
    return json;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return std::fprintf(stderr, "usage: mesh_simplify MODEL TRIANGLES [REPEATS [OTHER]]\n"), 2;
    const auto model = data::read_polygon_mesh(argv[1]);
    if (!model) return std::fprintf(stderr, "%s\n", model.message().c_str()), 1;
    const data::MeshNode& largest = largest_node(*model);
    const Task task =
        make_task(largest, static_cast<size_t>(std::atoll(argv[2])), argc > 3 ? std::atoi(argv[3]) : 5);
    nlohmann::json json = {{"full_triangles", largest.triangles.size()},
                           {"harrier", by_hierarchy(task)},
                           {"meshoptimizer", by_meshoptimizer(task)}};
    if (argc > 4) json["other"] = by_another(task, argv[4]);
    std::printf("%s\n", json.dump().c_str());
    return 0;
}
