// Builds the cluster tree of the construction site, or of a high-rise of so many objects, and counts what overviews of
// it need. Reported, not gated (docs/hdlod.md).
//
//     cluster_bench site|OBJECTS [THREADS [TOLERANCE_PX]]
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "data/scenes/construction_site.h"
#include "data/scenes/scene_family.h"
#include "objects/clustering/cluster_build.h"
#include "objects/display.h"

namespace {

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of this process, all threads.
double cpu_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void print_levels(const objects::ClusterTree& tree) {
    struct Sums {
        size_t clusters = 0, leaves = 0;
        uint64_t triangles = 0, below = 0;
        double error_m = 0.0, size_m = 0.0, gamma = 0.0;
    };
    for (int motion_class = 0; motion_class < 3; ++motion_class) {
        std::vector<Sums> levels(64);
        for (const objects::Cluster& c : tree.clusters) {
            if (static_cast<int>(c.motion_class) != motion_class) continue;
            Sums& sums = levels[c.level];
            ++sums.clusters;
            sums.leaves += c.child_count == 0;
            sums.size_m += double(c.size_m);
            sums.gamma += double(c.gamma);
            if (c.geometry == objects::kNoGeometry) continue;
            sums.error_m += double(c.error_m);
            sums.triangles += tree.geometries[c.geometry].index_count / 3;
        }
        std::printf("class %d: level clusters triangles mean error, size m, gamma\n", motion_class);
        for (size_t level = 0; level < levels.size(); ++level) {
            const Sums& s = levels[level];
            if (s.clusters == 0) continue;
            const double n = static_cast<double>(s.clusters);
            std::printf("  %2zu %7zu %9lu  %.4f %.1f %.4f\n", level, s.clusters, s.triangles, s.error_m / n,
                        s.size_m / n, s.gamma / n);
        }
    }
}

void print_overviews(const objects::ClusterTree& tree, double tolerance_px) {
    const objects::Cluster& root = tree.clusters[0];
    const glm::dvec3 middle(0.0, 0.0, 120.0);
    std::printf(
        "W %.0f m; overviews at %.1f px: share of the screen, time: commands (leaves, movers), triangles\n",
        double(root.size_m), tolerance_px);
    for (const double times : {1.0, 2.0, 4.0}) {
        for (const double share : {0.0, 0.15, 1.0 / 3, 0.5, 2.0 / 3, 0.85, 1.0}) {
            lod::View optics;
            optics.fov_y_rad = 0.7853981633974483;
            optics.width_px = 1280;
            optics.height_px = 720;
            const lod::View view =
                lod::look_at(middle + times * glm::dvec3(330.0, -330.0, 200.0), middle, {0, 0, 1}, optics);
            const objects::SceneView seen(view, {});
            std::vector<objects::ClusterId> drawn;
            objects::display(tree, {&seen, 1}, share * tree.end_s, tolerance_px, drawn);
            size_t leaves = 0, movers = 0, mover_triangles = 0;
            uint64_t triangles = 0;
            for (objects::ClusterId id : drawn) {
                const objects::Cluster& c = tree.clusters[id];
                const uint32_t count = tree.geometries[c.geometry].index_count / 3;
                triangles += count;
                const bool is_mover = c.motion_class == data::MotionClass::kDynamic;
                leaves += !is_mover && tree.is_leaf(id);
                movers += is_mover;
                mover_triangles += is_mover ? count : 0;
            }
            std::printf("  1/%-3.0f %.2f: %6zu (%zu, %zu) %8lu (movers %zu)\n", times * times, share,
                        drawn.size(), leaves, movers, triangles, mover_triangles);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const std::string name = count > 1 ? words[1] : "site";
    objects::BuildOptions options;
    options.threads = count > 2 ? static_cast<unsigned>(std::atoi(words[2])) : 2;
    const double tolerance_px = count > 3 ? std::atof(words[3]) : 2.0;
    double begin = now_s();
    data::FamilyOptions family;
    if (name != "site") family.objects = static_cast<uint32_t>(std::atoi(name.c_str()));
    const data::TimedScene scene =
        name == "site" ? data::generate_construction_site(1) : data::generate_family(family);
    uint64_t triangles = 0;
    for (const data::TimedObject& object : scene.objects)
        triangles += scene.meshes[object.mesh].triangles.size();
    std::printf("%zu objects, %zu meshes, %lu triangles in %.1f s\n", scene.objects.size(),
                scene.meshes.size(), triangles, now_s() - begin);
    begin = now_s();
    const double cpu_begin = cpu_s();
    const objects::ClusterTree tree =
        objects::build_cluster_tree(scene, options, [&](const objects::BuildState& state) {
            std::printf("  %.1f s: level %u, %zu clusters, %lu nodes, %lu steps, %lu faces\n",
                        now_s() - begin, state.level, state.clusters, state.counts.nodes, state.counts.steps,
                        state.counts.faces);
        });
    std::printf(
        "built in %.1f s, %.1f s of processors: %zu clusters, %zu geometries, %zu visibilities, %zu steps, "
        "%zu motions, %.0f MB of vertices, %.0f MB of indices; at most %.0f MB\n",
        now_s() - begin, cpu_s() - cpu_begin, tree.clusters.size(), tree.geometries.size(),
        tree.visibilities.size(), tree.step_time_s.size(), tree.motions.size(),
        double(tree.vertices.size() * 32) / 1e6, double(tree.indices.size() * 4) / 1e6, peak_mb());
    print_levels(tree);
    print_overviews(tree, tolerance_px);
}
