// Speed of the terrain front on a fractal 4097 x 4097 grid, beside a stateless rebuild of the same accuracy.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/bench/split_only_roam.h"
#include "tests/terrain/test_relief.h"

namespace {

constexpr double kRate = 60.0, kSpeed = 100.0;

const data::HeightGrid& grid() {
    static const data::HeightGrid g = terrain_test::fractal_grid(4097, 4097, 10.0, 2500.0, 1);
    return g;
}
const terrain::DiamondTable& table() {
    static const terrain::DiamondTable e = terrain::make_diamond_table(grid(), 2);
    return e;
}

lod::View flight(int frame) {
    const double s = kSpeed / kRate * frame;
    return terrain_test::level_view({8000.0 + s * 0.6, 9000.0 + s * 0.8, 1600.0}, 0.6435, -0.12);
}

lod::View elsewhere() {
    return terrain_test::level_view({31000.0, 30000.0, 1500.0}, 4.0, -0.1);
}

/// The tolerance at which the flight's mesh has about `triangles` triangles.
double tolerance_for(uint64_t triangles) {
    bench::SplitOnlyRoam rebuild(grid(), table());
    double low = 0.1, high = 50.0;
    for (int i = 0; i < 30; ++i) {
        const double middle = std::sqrt(low * high);
        (rebuild.build(flight(0), middle) > triangles ? low : high) = middle;
    }
    return high;
}

terrain::RoamFront make_front(double tolerance, bool pruning) {
    return terrain::RoamFront(
        table(),
        {.tolerance_px = tolerance, .threads = 2, .reserve_triangles = 400'000, .is_pruning = pruning});
}

uint64_t adapt(terrain::RoamFront& front, const lod::View& view, double tolerance) {
    lod::Front* fronts[] = {&front};
    front.begin_frame({&view, 1}, 0.0);
    return lod::schedule(fronts, {.tolerance_px = tolerance}, lod::operation_limit(UINT64_MAX)).operations;
}

/// The least processor time of several goes, seconds.
class LeastTime {
  public:
    template <typename Work>
    void of(const Work& work) {
        const double begin_s = now_s();
        work();
        least_s_ = std::min(least_s_, now_s() - begin_s);
    }
    double s() const { return least_s_; }

  private:
    static double now_s() {
        timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return double(now.tv_sec) + double(now.tv_nsec) * 1e-9;
    }
    double least_s_ = 1e30;
};

void Errors4097(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(terrain::make_diamond_table(grid(), static_cast<unsigned>(state.range(0))));
}
BENCHMARK(Errors4097)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(2);

void RebuildStateless(benchmark::State& state) {
    const double tolerance = tolerance_for(50'000);
    bench::SplitOnlyRoam rebuild(grid(), table());
    uint64_t triangles = 0;
    int frame = 0;
    for (auto _ : state)
        triangles = rebuild.build(flight(frame++ % 60), tolerance);
    state.counters["triangles"] = double(triangles);
    state.counters["ns_per_triangle"] =
        benchmark::Counter(double(triangles) * double(state.iterations()) * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(RebuildStateless)->Unit(benchmark::kMillisecond);

/// From two triangles to 50,000 and back, one operation at a time: splits and merges per second.
void SplitsAndMerges(benchmark::State& state) {
    const double tolerance = tolerance_for(50'000);
    auto front = make_front(tolerance, false);
    lod::Front* fronts[] = {&front};
    const lod::View view = flight(0);
    front.begin_frame({&view, 1}, 0.0);
    uint64_t changes = 0;
    for (auto _ : state) {
        while (front.refine_error_px() > tolerance)
            changes += front.refine().steps;
        while (front.mesh().triangles() > 2)
            changes += front.coarsen(1e30).steps;
    }
    static_cast<void>(fronts);
    state.counters["changes_per_s"] = benchmark::Counter(double(changes), benchmark::Counter::kIsRate);
    state.counters["triangles_per_s"] =
        benchmark::Counter(2.0 * double(changes), benchmark::Counter::kIsRate);
}
BENCHMARK(SplitsAndMerges)->Unit(benchmark::kMillisecond);

void CoherentFlight(benchmark::State& state) {
    const double tolerance = tolerance_for(50'000);
    auto front = make_front(tolerance, true);
    adapt(front, flight(0), tolerance);
    int frame = 0;
    uint64_t operations = 0;
    const uint64_t before = front.evaluations();
    for (auto _ : state)
        operations += adapt(front, flight(++frame), tolerance);
    state.counters["triangles"] = double(front.triangles());
    state.counters["operations"] = double(operations) / double(state.iterations());
    state.counters["evaluations"] = double(front.evaluations() - before) / double(state.iterations());
    state.counters["records"] = double(front.mesh().live_count());
    state.counters["bytes_per_triangle"] = double(front.memory_bytes()) / double(front.triangles());
}
BENCHMARK(CoherentFlight)->Unit(benchmark::kMillisecond)->Iterations(600);

void StandingStill(benchmark::State& state) {
    const double tolerance = tolerance_for(50'000);
    auto front = make_front(tolerance, true);
    adapt(front, flight(0), tolerance);
    for (auto _ : state)
        adapt(front, flight(0), tolerance);
}
BENCHMARK(StandingStill)->Unit(benchmark::kMillisecond);

/// 0: enhMerge; 1: merges one by one; 2: reset and split anew. `rebuilds`: what it costs beside a stateless rebuild of
/// the same view at the same tolerance, turn about, least times; the worse of there and back.
void incoherent(benchmark::State& state, const lod::View& there) {
    const double tolerance = tolerance_for(50'000);
    auto front = make_front(tolerance, state.range(0) == 0);
    bench::SplitOnlyRoam rebuild(grid(), table());
    adapt(front, flight(0), tolerance);
    uint64_t operations = 0;
    bool away = false;
    LeastTime front_s[2], rebuild_s[2];
    for (auto _ : state) {
        away = !away;
        const lod::View view = away ? there : flight(0);
        front_s[away].of([&] {
            if (state.range(0) == 2) front.reset();
            operations += adapt(front, view, tolerance);
        });
        state.PauseTiming();
        rebuild_s[away].of([&] { benchmark::DoNotOptimize(rebuild.build(view, tolerance)); });
        state.ResumeTiming();
    }
    state.counters["operations"] = double(operations) / double(state.iterations());
    state.counters["triangles"] = double(front.triangles());
    state.counters["rebuilds"] =
        std::max(front_s[0].s() / rebuild_s[0].s(), front_s[1].s() / rebuild_s[1].s());
}
void Teleport(benchmark::State& state) {
    incoherent(state, elsewhere());
}
BENCHMARK(Teleport)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void TurnAround(benchmark::State& state) {
    lod::View back = flight(0);
    back.eye_from_world = lod::eye_from_attitude(glm::dmat3(1.0), 0.6435 + 3.14159265, -0.12, 0.0);
    incoherent(state, back);
}
BENCHMARK(TurnAround)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

/// 0: each frame of a flight writes what it changed; 1: everything is walked and written anew.
void Emit(benchmark::State& state) {
    const double tolerance = tolerance_for(50'000);
    auto front = make_front(tolerance, true);
    adapt(front, flight(0), tolerance);
    lod::DrawList list;
    front.place(front.pool_need());
    front.emit(flight(0), list);
    uint64_t written = 0;
    int frame = 0;
    for (auto _ : state) {
        state.PauseTiming();
        const lod::View view = flight(++frame);
        adapt(front, view, tolerance);
        list.clear();
        state.ResumeTiming();
        if (state.range(0) == 1) front.place(front.pool_need());
        front.emit(view, list);
        for (const lod::IndexWrite& write : list.index_writes)
            written += write.indices.size();
    }
    state.counters["triangles"] = double(front.emitted_triangles());
    state.counters["indices"] = double(written) / double(state.iterations());
}
BENCHMARK(Emit)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(300);

}  // namespace

BENCHMARK_MAIN();
