// Speed of edits of relief: a crater 200 m across at 1 m between samples, in grids of 1025 and 4097 samples a side.
#include <benchmark/benchmark.h>

#include "data/relief_edit.h"
#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/test_relief.h"

namespace {

/// A front over a grid, converged over the place of the crater.
struct Range {
    explicit Range(int side)
        : grid(terrain_test::fractal_grid(side, side, 1.0, 0.1 * side, 1)),
          extremes(data::make_height_extremes(grid, 2)),
          front(terrain::make_diamond_table(grid, 2),
                {.tolerance_px = 1.0, .threads = 2, .reserve_triangles = 400'000}) {
        data::Crater crater;
        crater.centre_grid = {side / 2 + 30, side / 2 + 50};
        block = data::make_block(grid, crater);
        const double height_m = double(grid.at(side / 2, side / 2)) + 60.0;
        view = terrain_test::level_view({side / 2.0, side / 2.0 - 250.0, height_m}, 0.0, -0.2);
        adapt();
    }
    void adapt() {
        lod::Front* fronts[] = {&front};
        front.begin_frame({&view, 1}, 0.0);
        lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(UINT64_MAX));
    }
    terrain::FrontEditCounts edit() {
        data::exchange(grid, block);
        data::update(extremes, grid, block.range);
        return front.edit({grid, extremes, block.range});
    }

    data::HeightGrid grid;
    data::HeightExtremes extremes;
    terrain::RoamFront front;
    data::HeightBlock block;
    lod::View view;
};

Range& range_of(int64_t side) {
    static Range small(1025), large(4097);
    return side == 1025 ? small : large;
}

/// Heights, extremes, table, front: what a frame with an edit does before it adapts.
void Edit(benchmark::State& state) {
    Range& range = range_of(state.range(0));
    terrain::FrontEditCounts counts;
    for (auto _ : state) {
        counts = range.edit();
        state.PauseTiming();
        range.adapt();
        state.ResumeTiming();
    }
    state.counters["samples"] = double(range.block.range.count());
    state.counters["diamonds"] = double(counts.table.computed);
    state.counters["searched"] = double(counts.table.searched_samples);
    state.counters["records"] = double(counts.records);
    state.counters["vertices"] = double(counts.vertices);
}
BENCHMARK(Edit)->Arg(1025)->Arg(4097)->Unit(benchmark::kMillisecond)->Iterations(20)->MeasureProcessCPUTime();

/// The adaptation after it.
void Adapt(benchmark::State& state) {
    Range& range = range_of(state.range(0));
    for (auto _ : state) {
        state.PauseTiming();
        range.edit();
        state.ResumeTiming();
        range.adapt();
    }
}
BENCHMARK(Adapt)
    ->Arg(1025)
    ->Arg(4097)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20)
    ->MeasureProcessCPUTime();

/// What an edit replaces: the whole table anew.
void Anew(benchmark::State& state) {
    const Range& range = range_of(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(terrain::make_diamond_table(range.grid, 2));
}
BENCHMARK(Anew)->Arg(1025)->Arg(4097)->Unit(benchmark::kMillisecond)->Iterations(3)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
