// batch_bench DEM|FRACTAL_SIDE TOLERANCE_PX FRAMES: leaves drawn as 4^k triangles, k = 0 … 3, side by side at one
// guaranteed error: triangles, times, index order, bytes. Prints a Markdown table; docs/batched_leaves.md explains it.
//
// The fronts take turns frame by frame, each first in every fourth frame. Times are the median and the least of the
// flight of `harrier terrain compare`, 1280 x 720; its teleports adapt and emit only.
#include <meshoptimizer.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>

#include "data/fractal_grid.h"
#include "lod/scheduler.h"
#include "render/renderer.h"
#include "sim/compare/sorties.h"
#include "sim/compare/statistics.h"
#include "sim/progress.h"
#include "terrain/batched_errors.h"
#include "terrain/drawn/drawn_mesh.h"
#include "terrain/roam_front.h"
#include "tests/bench/vertex_cache.h"

namespace {

struct Entrant {
    int batch = 0;
    double prepare_s = 0.0;
    std::unique_ptr<terrain::RoamFront> front;
    lod::PoolRegion region;
    terrain::PoolTwin pool;
    lod::DrawList list;
    std::vector<double> adapt_us, emit_us, frame_ms, teleport_us, upload_bytes, operations;
};

struct Cpu {
    double adapt_us = 0.0, emit_us = 0.0;
    uint64_t operations = 0;
};

Cpu adapt(Entrant& entrant, const lod::View& view, double time_s, double tolerance_px) {
    Cpu cpu;
    lod::Front* fronts[] = {entrant.front.get()};
    const sim::Stopwatch adapting;
    entrant.front->begin_frame({&view, 1}, time_s);
    cpu.operations =
        lod::schedule(fronts, {.tolerance_px = tolerance_px}, lod::operation_limit(UINT64_MAX)).operations;
    cpu.adapt_us = adapting.ms() * 1e3;
    const lod::PoolRegion need = entrant.front->pool_need();
    if (need.vertex_capacity > entrant.region.vertex_capacity ||
        need.index_capacity > entrant.region.index_capacity) {
        entrant.region = need;  // nobody draws it any more
        entrant.front->place(need);
    }
    const sim::Stopwatch emitting;
    entrant.list.clear();
    entrant.front->emit(view, entrant.list);
    cpu.emit_us = emitting.ms() * 1e3;
    return cpu;
}

double upload_bytes(const lod::DrawList& list) {
    size_t bytes = 0;
    for (const lod::VertexWrite& write : list.vertex_writes)
        bytes += write.vertices.size_bytes();
    for (const lod::IndexWrite& write : list.index_writes)
        bytes += write.indices.size_bytes();
    return double(bytes);
}

/// One frame with its picture.
void fly(Entrant& entrant, const lod::View& view, double time_s, double tolerance_px,
         render::Renderer& renderer, bool counts) {
    render::Atmosphere air;
    air.up_world = air.sun_world = glm::transpose(view.eye_from_world)[1];
    air.draw_sky = false;
    const sim::Stopwatch watch;
    const Cpu cpu = adapt(entrant, view, time_s, tolerance_px);
    renderer.draw(view, entrant.list, air);
    renderer.finish();
    const double frame_ms = watch.ms();
    entrant.pool.apply(entrant.list);
    if (!counts) return;
    entrant.adapt_us.push_back(cpu.adapt_us);
    entrant.emit_us.push_back(cpu.emit_us);
    entrant.operations.push_back(double(cpu.operations));
    entrant.frame_ms.push_back(frame_ms);
    entrant.upload_bytes.push_back(upload_bytes(entrant.list));
}

/// What the items draw, gaps left out.
std::vector<uint32_t> drawn_indices(const Entrant& entrant) {
    std::vector<uint32_t> out;
    for (const lod::DrawItem& item : entrant.list.items) {
        for (uint32_t i = 0; i + 2 < item.index_count; i += 3) {
            const uint32_t* triangle = &entrant.pool.indices[item.first_index + i];
            if (triangle[0] != triangle[1]) out.insert(out.end(), triangle, triangle + 3);
        }
    }
    return out;
}

/// The last frame of the flight.
struct Order {
    uint64_t drawn = 0, leaves = 0;
    double fifo16 = 0.0, fifo32 = 0.0, best16 = 0.0, best32 = 0.0, bytes = 0.0;
};

Order order_of(const Entrant& entrant) {
    const std::vector<uint32_t> indices = drawn_indices(entrant);
    const std::set<uint32_t> vertices(indices.begin(), indices.end());
    size_t listed = 0;
    for (const lod::DrawItem& item : entrant.list.items)
        listed += item.index_count;
    Order order;
    order.drawn = entrant.front->emitted_triangles();
    order.leaves = entrant.front->mesh().triangles();
    std::vector<uint32_t> best(indices.size());
    order.fifo16 = bench::fifo_misses_a_triangle(indices, 16);
    order.fifo32 = bench::fifo_misses_a_triangle(indices, 32);
    const size_t slots = vertices.empty() ? 0 : *vertices.rbegin() + 1;
    meshopt_optimizeVertexCacheFifo(best.data(), indices.data(), indices.size(), slots, 16);
    order.best16 = bench::fifo_misses_a_triangle(best, 16);
    meshopt_optimizeVertexCacheFifo(best.data(), indices.data(), indices.size(), slots, 32);
    order.best32 = bench::fifo_misses_a_triangle(best, 32);
    order.bytes = double(vertices.size() * sizeof(lod::Vertex) + listed * sizeof(uint32_t)) * 3.0 /
                  double(std::max<size_t>(indices.size(), 1));
    return order;
}

std::vector<Entrant> make_entrants(const data::HeightGrid& grid, double tolerance_px,
                                   const lod::View& first) {
    const terrain::DiamondTable table = terrain::make_diamond_table(grid, 2);
    std::vector<Entrant> entrants;
    for (int batch = 0; batch <= terrain::kMostBatch; ++batch) {
        Entrant& entrant = entrants.emplace_back();
        entrant.batch = batch;
        terrain::RoamOptions options{.tolerance_px = tolerance_px, .batch = batch};
        entrant.front = std::make_unique<terrain::RoamFront>(table, options);
        lod::Front* fronts[] = {entrant.front.get()};
        entrant.front->begin_frame({&first, 1}, 0.0);
        lod::schedule(fronts, {.tolerance_px = tolerance_px}, lod::operation_limit(UINT64_MAX));
        options.reserve_triangles = 2 * entrant.front->triangles();
        const sim::Stopwatch watch;
        entrant.front = std::make_unique<terrain::RoamFront>(table, options);
        entrant.prepare_s = watch.seconds();
    }
    return entrants;
}

lod::Result<lod::Ok> place_all(std::vector<Entrant>& entrants, render::Renderer& renderer) {
    render::PoolCapacity pool{0, 0, 4096};
    for (Entrant& entrant : entrants) {
        entrant.region = entrant.front->pool_need();
        entrant.region.first_vertex = pool.vertices;
        entrant.region.first_index = pool.indices;
        pool.vertices += entrant.region.vertex_capacity;
        pool.indices += entrant.region.index_capacity;
        entrant.front->place(entrant.region);
    }
    return renderer.resize_pool(pool);
}

void teleport(Entrant& entrant, const sim::Sorties& sorties, double tolerance_px) {
    for (const lod::View& view : sorties.teleports) {
        const Cpu cpu = adapt(entrant, view, 1000.0, tolerance_px);
        entrant.teleport_us.push_back(cpu.adapt_us + cpu.emit_us);
    }
}

void print(const Entrant& e, const Order& order) {
    const auto least = [](const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); };
    std::printf(
        "| %d | %llu | %llu | %.0f | %.0f / %.0f | %.0f / %.0f | %.1f / %.1f | %.1f | %.2f / %.2f | %.2f / "
        "%.2f | "
        "%.1f | %.0f |\n",
        e.batch, static_cast<unsigned long long>(order.drawn), static_cast<unsigned long long>(order.leaves),
        sim::mean(e.operations), sim::percentile(e.adapt_us, 0.5), least(e.adapt_us),
        sim::percentile(e.emit_us, 0.5), least(e.emit_us), sim::percentile(e.frame_ms, 0.5),
        least(e.frame_ms), sim::percentile(e.teleport_us, 0.5) * 1e-3, order.fifo16, order.fifo32,
        order.best16, order.best32, order.bytes, sim::mean(e.upload_bytes) * 1e-3);
}

int run(const data::HeightGrid& grid, double tolerance_px, int frames) {
    const sim::Sorties sorties = sim::plan_sorties(grid, {.frames = frames});
    std::vector<Entrant> entrants = make_entrants(grid, tolerance_px, sorties.flight.front());
    auto renderer = render::Renderer::create({.width_px = 1280, .height_px = 720, .pool = {1, 3, 16}});
    if (!renderer) return std::fprintf(stderr, "%s\n", renderer.message().c_str()), 1;
    if (auto placed = place_all(entrants, *renderer); !placed) return 1;
    for (int frame = -4; frame < frames; ++frame) {
        const lod::View& view = sorties.flight[static_cast<size_t>(std::max(frame, 0))];
        for (size_t turn = 0; turn < entrants.size(); ++turn) {
            fly(entrants[(turn + static_cast<size_t>(frame + 4)) % entrants.size()], view,
                frame / sim::kRate_hz, tolerance_px, *renderer, frame >= 0);
        }
    }
    std::vector<Order> orders;
    for (const Entrant& entrant : entrants)
        orders.push_back(order_of(entrant));
    std::printf(
        "| k | triangles drawn | leaves | operations a frame | adapt us, p50 / least | emit us | frame ms | "
        "teleport ms | ACMR 16 / 32 | meshoptimizer's | bytes a triangle | upload kB |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < entrants.size(); ++i) {
        teleport(entrants[i], sorties, tolerance_px);
        print(entrants[i], orders[i]);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: batch_bench DEM|FRACTAL_SIDE TOLERANCE_PX FRAMES\n");
        return 2;
    }
    const double tolerance_px = std::atof(argv[2]);
    const int frames = std::atoi(argv[3]), side = std::atoi(argv[1]);
    if (side > 1) return run(data::fractal_grid(side, side, 1.0, 300.0, 1), tolerance_px, frames);
    const auto grid = data::read_height_grid({argv[1]}, {});
    if (!grid) return std::fprintf(stderr, "%s\n", grid.message().c_str()), 1;
    return run(*grid, tolerance_px, frames);
}
