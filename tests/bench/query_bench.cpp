// Speed of questions about the ground: heights one by one and in batches, lines of sight by length and height.
#include <benchmark/benchmark.h>

#include "data/ground_query.h"
#include "data/line_of_sight.h"
#include "tests/terrain/test_relief.h"

namespace {

enum Ground : int64_t { kPlane, kDegrees, kUtm };

/// 4097 x 4097 samples 30 m apart of the same relief: on a plane, in degrees, in UTM.
const data::HeightGrid& grid(int64_t ground) {
    static const auto on = [](const std::array<double, 6>& geo_transform, const char* crs) {
        data::HeightGrid g = terrain_test::fractal_grid(4097, 4097, 30.0, 2500.0, 1);
        if (*crs != '\0') g.frame = *data::GroundFrame::make(geo_transform, crs, g.width, g.height);
        return g;
    };
    static const data::HeightGrid grids[] = {on({}, ""),
                                             on({7.0, 1.0 / 3600, 0.0, 46.0, 0.0, -1.0 / 3600}, "EPSG:4326"),
                                             on({400000.0, 30.0, 0.0, 5100000.0, 0.0, -30.0}, "EPSG:32632")};
    return grids[ground];
}

/// Of all three: their heights are the same.
const data::HeightPyramid& pyramid() {
    static const data::HeightPyramid all = data::make_height_pyramid(grid(kPlane), 2);
    return all;
}

/// Ends above_m above the ground, length_m apart.
std::vector<data::WorldLine> lines(const data::HeightGrid& g, double length_m, double above_m) {
    lod::Rng rng(5);
    std::vector<data::WorldLine> out;
    while (out.size() < 4096) {
        const double angle = rng.between(0.0, 6.283185307);
        const glm::dvec2 a(rng.between(0.0, 4096.0), rng.between(0.0, 4096.0));
        const glm::dvec2 b = a + length_m * glm::dvec2(std::cos(angle), std::sin(angle)) / g.frame.cell_m();
        if (!data::is_inside(g, b.x, b.y)) continue;
        const auto world = [&](const glm::dvec2& p) {
            return g.frame.world_from_grid(p.x, p.y, data::ground_height(g, p.x, p.y).height_m + above_m);
        };
        out.push_back({world(a), world(b)});
    }
    return out;
}

void HeightsUnder(benchmark::State& state) {
    const data::HeightGrid& g = grid(state.range(0));
    const bool is_batch = state.range(1) != 0;
    std::vector<glm::dvec3> points;
    for (const data::WorldLine& line : lines(g, 10000.0, 100.0))
        points.push_back(line.from);
    std::vector<data::GroundAnswer> out(points.size());
    for (auto _ : state) {
        if (is_batch) {
            data::ground_under(g, points, out, 1);
        } else {
            for (size_t i = 0; i < points.size(); ++i)
                out[i] = data::ground_under(g, points[i]);
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(points.size()));
}
BENCHMARK(HeightsUnder)->ArgNames({"ground", "batch"})->ArgsProduct({{kPlane, kDegrees, kUtm}, {0, 1}});

void LinesOfSight(benchmark::State& state) {
    const data::HeightGrid& g = grid(state.range(0));
    const auto all = lines(g, double(state.range(1)) * 1000.0, double(state.range(2)));
    std::vector<data::Sight> out(all.size());
    for (auto _ : state)
        data::lines_of_sight(g, pyramid(), all, out, 1);
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(all.size()));
    double blocked = 0.0;
    for (const data::Sight& sight : out)
        blocked += sight.is_blocked;
    state.counters["blocked"] = blocked / double(out.size());
}
BENCHMARK(LinesOfSight)
    ->ArgNames({"ground", "km", "above_m"})
    ->ArgsProduct({{kPlane, kDegrees, kUtm}, {5, 50}, {2, 100, 1000}});

void Pyramid(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(
            data::make_height_pyramid(grid(kPlane), static_cast<unsigned>(state.range(0))));
    state.SetItemsProcessed(state.iterations() * 4097 * 4097);
}
BENCHMARK(Pyramid)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
