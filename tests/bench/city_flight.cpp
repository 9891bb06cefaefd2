// Frames of the city of prism_city.h under a bound: an overview from a circle, a flight above the roofs, a drive through a
// street; whole frames, waited for. A line each, or of one (over, fly, drive); city_compare.py sets them beside other
// programs'.
//
//     city_flight TREE.hdlod [TOLERANCE_PX [FRAMES [WAY [SUFFIX.png]]]]
//
// The tree is read from the file, or built and kept there, which takes a quarter of an hour and more.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <optional>
#include <vector>

#include "data/file_bytes.h"
#include "lod/scheduler.h"
#include "objects/cluster_front.h"
#include "objects/clustering/cluster_build.h"
#include "objects/tree_file.h"
#include "render/renderer.h"
#include "tests/bench/prism_city.h"

namespace {

constexpr int kWidth_px = 1280, kHeight_px = 720;
constexpr int kWarmUpFrames = 3;

double now_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Of this process, all threads.
double cpu_ms() {
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double percentile(std::vector<double> values, double share) {
    const size_t at = std::min(values.size() - 1, static_cast<size_t>(share * double(values.size())));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

struct Way {
    const char* name;
    lod::View (*view)(double share, const lod::View& optics);  ///< share of the way, 0 … 1
};

lod::View overview(double share, const lod::View& optics) {
    const double angle = 2.0 * std::numbers::pi * share;
    const glm::dvec3 middle(1500.0, 1500.0, 0.0);
    const glm::dvec3 eye = middle + glm::dvec3(2200.0 * std::cos(angle), 2200.0 * std::sin(angle), 900.0);
    return lod::look_at(eye, middle, {0.0, 0.0, 1.0}, optics);
}

lod::View flight(double share, const lod::View& optics) {
    const auto place = [](double at) {
        return glm::dvec3(300.0 + 2400.0 * at, 1500.0 + 1000.0 * std::sin(2.0 * std::numbers::pi * at), 80.0);
    };
    const glm::dvec3 ahead = glm::normalize(place(share + 0.02) - place(share));
    return lod::look_at(place(share), place(share) + glm::dvec3(100.0 * ahead.x, 100.0 * ahead.y, -15.0),
                        {0.0, 0.0, 1.0}, optics);
}

lod::View drive(double share, const lod::View& optics) {
    const glm::dvec3 eye(300.0 + 2400.0 * share, 118.0 * bench::kCityCell_m, 2.0);
    return lod::look_at(eye, eye + glm::dvec3(100.0, 20.0 * std::sin(12.0 * share), 0.0), {0.0, 0.0, 1.0},
                        optics);
}

constexpr Way kWays[] = {{"over", overview}, {"fly", flight}, {"drive", drive}};

struct Figures {
    std::vector<double> wall_ms, cpu_ms, triangles, items;
    double error_px = 0.0;
};

class City {
  public:
    City(objects::ClusterFront& front, render::Renderer renderer, double tolerance_px)
        : front_(front), renderer_(std::move(renderer)) {
        budget_.tolerance_px = tolerance_px;
        air_.clear_colour = {0.5f, 0.6f, 0.8f};
        air_.sun_world = glm::normalize(glm::dvec3(0.5, 0.3, 0.81));
    }

    Figures fly(const Way& way, int frames) {
        lod::View optics;
        optics.width_px = kWidth_px;
        optics.height_px = kHeight_px;
        optics.fov_y_rad = std::numbers::pi / 4.0;
        optics.near_m = 0.5;
        Figures figures;
        for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
            const lod::View view = way.view(std::max(frame, 0) / double(frames), optics);
            const double wall = now_ms(), cpu = cpu_ms();
            draw(view);
            if (frame < 0) continue;
            figures.wall_ms.push_back(now_ms() - wall);
            figures.cpu_ms.push_back(cpu_ms() - cpu);
            figures.triangles.push_back(double(front_.emitted_triangles()));
            figures.items.push_back(double(list_.items.size()));
            figures.error_px = std::max(figures.error_px, front_.error_px());
        }
        return figures;
    }

    render::ColourImage picture() { return renderer_.read_colour(); }

  private:
    void draw(const lod::View& view) {
        lod::Front* const fronts[] = {&front_};
        front_.begin_frame({&view, 1}, 0.0);
        lod::schedule(fronts, budget_, lod::operation_limit(UINT64_MAX));
        list_.clear();
        front_.emit(view, list_);
        renderer_.draw(view, list_, air_);
        renderer_.finish();
    }

    objects::ClusterFront& front_;
    render::Renderer renderer_;
    lod::Budget budget_;
    lod::DrawList list_;
    render::Atmosphere air_ = render::vacuum();
};

void print(const Way& way, const Figures& f) {
    std::printf(
        "{\"way\": \"%s\", \"wall_ms\": %.2f, \"wall_p99_ms\": %.2f, \"cpu_ms\": %.2f, \"triangles\": %.0f, "
        "\"items\": %.0f, \"error_px\": %.2f}\n",
        way.name, percentile(f.wall_ms, 0.5), percentile(f.wall_ms, 0.99), percentile(f.cpu_ms, 0.5),
        percentile(f.triangles, 0.5), percentile(f.items, 0.5), f.error_px);
}

std::optional<objects::ClusterTree> read_tree(const std::string& path) {
    const auto bytes = data::read_file(path, size_t{4} << 30);
    if (!bytes) return std::nullopt;
    auto tree = objects::decode_tree(*bytes);
    if (tree) return std::move(*tree);
    std::fprintf(stderr, "%s: %s\n", path.c_str(), tree.message().c_str());
    return std::nullopt;
}

objects::ClusterTree build_tree(const std::string& path) {
    objects::BuildOptions options;
    options.threads = 2;
    options.spent_share = 0.02;  // no two prisms are alike: what is nearly exact pays
    options.levels_per_doubling = 6;
    options.first_sizes = 3.36;
    options.error_share =
        0.0141;  // small clusters for their error: what is near does not decide for what is far
    const double begin = now_ms();
    objects::ClusterTree tree = objects::build_cluster_tree(bench::prism_city(), options);
    std::fprintf(stderr, "city: built in %.1f s\n", (now_ms() - begin) / 1e3);
    const std::vector<unsigned char> bytes = objects::encode_tree(tree);
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) std::fprintf(stderr, "%s: cannot keep the tree\n", path.c_str());
    return tree;
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) {
        std::fprintf(stderr, "expected the file of the city's tree, there or not\n");
        return 1;
    }
    const double tolerance_px = count > 2 ? std::atof(words[2]) : 2.0;
    const int frames = count > 3 ? std::max(std::atoi(words[3]), 1) : 60;
    const std::string only = count > 4 ? words[4] : "all", picture = count > 5 ? words[5] : "";
    std::optional<objects::ClusterTree> known = read_tree(words[1]);
    objects::ClusterTree tree = known ? std::move(*known) : build_tree(words[1]);
    std::fprintf(stderr, "city: %u objects in %zu clusters\n", tree.object_count, tree.clusters.size());
    render::RendererOptions rendering;
    rendering.width_px = kWidth_px;
    rendering.height_px = kHeight_px;
    objects::ClusterFront front(std::move(tree), {});
    front.set_hiding(objects::Hiding::kTriangles, 2);
    const lod::PoolRegion need = front.pool_need();
    front.place(need);
    rendering.pool = {need.vertex_capacity, need.index_capacity, 2 * front.tree().object_count + 64};
    auto renderer = render::Renderer::create(rendering);
    if (!renderer) {
        std::fprintf(stderr, "%s\n", renderer.message().c_str());
        return 1;
    }
    City city(front, std::move(*renderer), tolerance_px);
    for (const Way& way : kWays) {
        if (only != "all" && only != way.name) continue;
        print(way, city.fly(way, frames));
        if (!picture.empty()) (void)render::write_png(std::string(way.name) + picture, city.picture());
    }
}
