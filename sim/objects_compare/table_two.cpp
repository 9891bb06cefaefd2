#include "sim/objects_compare/table_two.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lod/scheduler.h"
#include "objects/cluster_front.h"
#include "objects/every_object.h"
#include "render/renderer.h"
#include "sim/progress.h"

namespace sim {
namespace {

constexpr double kFov_rad = 0.7853981633974483;  // 45 degrees
constexpr int kWarmUpFrames = 2;

struct Moment {
    const char* name;
    double share;  ///< of T
};
constexpr Moment kMoments[] = {{"start", 0.0}, {"third", 1.0 / 3.0}, {"two_thirds", 2.0 / 3.0}, {"end", 1.0}};
constexpr double kScreens[] = {1.0, 0.25, 0.0625};

/// The scene's bounding sphere just fits the picture's height at `screen` 1, half of it at 1/4, a quarter at 1/16; seen from the
/// south-west, 25 degrees above.
lod::View overview(const objects::Cluster& root, const TableTwoOptions& options, double screen) {
    lod::View optics;
    optics.width_px = options.width_px;
    optics.height_px = options.height_px;
    optics.fov_y_rad = kFov_rad;
    const double distance_m = double(root.radius_m) / (std::sin(kFov_rad / 2.0) * std::sqrt(screen));
    const glm::dvec3 away = glm::normalize(glm::dvec3(-1.0, -1.0, std::sqrt(2.0) * std::tan(0.4363)));
    const glm::dvec3 centre(root.centre);
    return lod::look_at(centre + away * distance_m, centre, {0.0, 0.0, 1.0}, optics);
}

/// No sky: only the scene's triangles cost.
render::Atmosphere clear_air() {
    render::Atmosphere air = render::vacuum();
    air.sun_world = glm::normalize(glm::dvec3(-0.3, -0.5, 0.8));
    air.clear_colour = {0.5f, 0.6f, 0.8f};
    return air;
}

/// One way to draw the scene, and its last frame.
struct Way {
    lod::Front& front;
    double tolerance_px;
    lod::DrawList list{};
    double ms = 0.0;
    uint64_t triangles = 0, commands = 0;
    double error_px = 0.0;

    void draw(const lod::View& view, double time_s, render::Renderer& renderer) {
        static constexpr uint64_t kEnough = 100'000'000;
        const Stopwatch watch;
        front.begin_frame({&view, 1}, time_s);
        lod::Budget budget;
        budget.tolerance_px = tolerance_px;
        lod::Front* const fronts[] = {&front};
        lod::schedule(fronts, budget, lod::operation_limit(kEnough));
        list.clear();
        front.emit(view, list);
        renderer.draw(view, list, clear_air());
        renderer.finish();
        ms = watch.ms();
        triangles = front.emitted_triangles();
        commands = list.items.size();
        error_px = front.error_px();
    }
};

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
    return values[values.size() / 2];
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Both ways, in turns, at the times given.
TableTwoRow run(Way& without, Way& with, const lod::View& view, const std::vector<double>& times_s,
                render::Renderer& renderer) {
    TableTwoRow row;
    for (int i = 0; i < kWarmUpFrames; ++i) {
        without.draw(view, times_s[0], renderer);
        with.draw(view, times_s[0], renderer);
    }
    std::vector<double> without_ms, with_ms;
    const bool is_still = times_s.front() == times_s.back();
    for (double time_s : times_s) {
        without.draw(view, time_s, renderer);
        with.draw(view, time_s, renderer);
        without_ms.push_back(without.ms);
        with_ms.push_back(with.ms);
        row.triangles_without += without.triangles;
        row.triangles_with += with.triangles;
        row.commands_without += without.commands;
        row.commands_with += with.commands;
        row.error_px = std::max(row.error_px, with.error_px);
    }
    row.without_ms = is_still ? median(without_ms) : mean(without_ms);
    row.with_ms = is_still ? median(with_ms) : mean(with_ms);
    for (uint64_t* sum :
         {&row.triangles_without, &row.triangles_with, &row.commands_without, &row.commands_with})
        *sum /= times_s.size();
    return row;
}

std::vector<double> even_times(double end_s, int count) {
    std::vector<double> times_s;
    for (int i = 0; i < count; ++i)
        times_s.push_back(end_s * i / std::max(count - 1, 1));
    return times_s;
}

lod::Result<render::Renderer> make_renderer(const objects::ClusterTree& tree,
                                            const TableTwoOptions& options) {
    render::RendererOptions rendering;
    rendering.width_px = options.width_px;
    rendering.height_px = options.height_px;
    rendering.pool = {static_cast<uint32_t>(tree.vertices.size()), static_cast<uint32_t>(tree.indices.size()),
                      2 * tree.object_count + 64};
    return render::Renderer::create(rendering);
}

}  // namespace

lod::Result<std::vector<TableTwoRow>> measure_table_two(
    objects::ClusterTree tree, const TableTwoOptions& options,
    const std::function<void(const std::string&)>& progress) {
    auto renderer = make_renderer(tree, options);
    if (!renderer) return renderer.error();
    objects::ClusterFront clusters(std::move(tree), {});
    objects::EveryObject every(clusters.tree(), {});
    clusters.place(clusters.pool_need());
    every.place(clusters.pool_need());
    Way with{clusters, options.tolerance_px}, without{every, 0.0};
    {
        const lod::View view = overview(clusters.tree().clusters[0], options, 1.0);
        with.draw(view, 0.0, *renderer);  // hands the geometry over
    }
    std::vector<TableTwoRow> rows;
    const double end_s = clusters.tree().end_s;
    const auto add = [&](const char* name, double screen, const std::vector<double>& times_s) {
        progress(std::string(name) + ", scene on " + std::to_string(screen) + " of the picture");
        rows.push_back(
            run(without, with, overview(clusters.tree().clusters[0], options, screen), times_s, *renderer));
        rows.back().time = name;
        rows.back().screen = screen;
    };
    for (double screen : kScreens) {
        for (const Moment& moment : kMoments)
            add(moment.name, screen, std::vector<double>(size_t(options.still_frames), moment.share * end_s));
        add("animation", screen, even_times(end_s, options.animation_frames));
    }
    return rows;
}

}  // namespace sim
