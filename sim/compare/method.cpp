#include "sim/compare/method.h"

#include <algorithm>

#include "lod/scheduler.h"
#include "sim/progress.h"
#include "terrain/rivals/rivals.h"
#include "terrain/roam_front.h"

namespace sim {
namespace {

constexpr double kCoarse_px = 1e5;

uint64_t table_bytes(const terrain::DiamondTable& table) {
    return table.slots.size() * sizeof(terrain::DiamondSource);
}

Method make_roam(const terrain::DiamondTable& table, const std::string& name, double glide_s) {
    Method method;
    method.name = name;
    method.make = [&table, glide_s](double tolerance_px, uint64_t triangles) {
        terrain::RoamOptions options;
        options.tolerance_px = tolerance_px;
        options.reserve_triangles = triangles;
        options.glide_s = glide_s;
        return std::make_unique<terrain::RoamFront>(table, options);
    };
    method.memory_bytes = [](const lod::Front& front) {
        const auto& roam = static_cast<const terrain::RoamFront&>(front);
        return roam.memory_bytes() + table_bytes(roam.table());
    };
    return method;
}

Method make_rival(const data::HeightGrid& grid, const terrain::DiamondTable& table,
                  const terrain::RivalClaims& claims, const MethodOptions& options) {
    Method method;
    method.name = claims.name;
    method.has_skirts = claims.seams == terrain::Seams::kSkirts;
    const terrain::RivalOptions rival{1.0, options.threads, options.block_cells};
    method.memory_bytes = [](const lod::Front& front) {
        return static_cast<const terrain::RivalFront&>(front).memory_bytes();
    };
    if (claims.kind == terrain::Rival::kRoamMergeOnly) {
        method.make = [&grid, &table, rival, kind = claims.kind](double tolerance_px, uint64_t) {
            terrain::RivalOptions own = rival;
            own.tolerance_px = tolerance_px;
            return terrain::make_rival(kind, grid, table, own);
        };
        return method;
    }
    const Stopwatch watch;
    method.front = terrain::make_rival(claims.kind, grid, table, rival);
    method.prepare_s = watch.seconds();
    return method;
}

bool is_wanted(const MethodOptions& options, std::string_view name) {
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), name) != options.only.end();
}

/// With room to grow: vertices that are there from the start do not.
lod::PoolRegion roomy(const lod::PoolRegion& need, const Method& method) {
    const uint32_t vertices = need.vertex_capacity + (method.make ? need.vertex_capacity / 4 : 0);
    return {0, vertices, 0, need.index_capacity + need.index_capacity / 4};
}

/// Into a region of its own that begins at 0.
void place_alone(Method& method) {
    const lod::PoolRegion need = method.front->pool_need();
    if (need.vertex_capacity <= method.region.vertex_capacity &&
        need.index_capacity <= method.region.index_capacity) {
        return;
    }
    method.region = roomy(need, method);
    method.front->place(method.region);
}

}  // namespace

std::vector<LeftOut> left_out(const data::HeightGrid& grid, const MethodOptions& options) {
    std::vector<LeftOut> out;
    for (const terrain::RivalClaims& claims : terrain::kRivals) {
        if (is_wanted(options, claims.name) && !terrain::can_make(claims.kind, grid))
            out.push_back({std::string(claims.name), "too many samples"});
    }
    return out;
}

std::vector<Method> make_methods(const data::HeightGrid& grid, const terrain::DiamondTable& table,
                                 double table_s, const MethodOptions& options) {
    std::vector<Method> methods;
    if (is_wanted(options, "roam_glide")) methods.push_back(make_roam(table, "roam_glide", kGlide_s));
    if (is_wanted(options, "roam")) methods.push_back(make_roam(table, "roam", 0.0));
    for (const terrain::RivalClaims& claims : terrain::kRivals) {
        if (!is_wanted(options, claims.name) || !terrain::can_make(claims.kind, grid)) continue;
        say_progress("preparing " + std::string(claims.name));
        methods.push_back(make_rival(grid, table, claims, options));
    }
    for (Method& method : methods)
        method.prepare_s += method.make ? table_s : 0.0;
    return methods;
}

void restart(Method& method, double tolerance_px, uint64_t triangles) {
    if (method.make) {
        method.front = method.make(tolerance_px, triangles);
        method.region = {};
        return;
    }
    lod::Front* fronts[] = {method.front.get()};
    lod::schedule(fronts, {.tolerance_px = kCoarse_px}, lod::operation_limit(UINT64_MAX));
}

Adaption adapt(Method& method, const lod::View& view, double time_s, double tolerance_px) {
    lod::Front* fronts[] = {method.front.get()};
    method.list.clear();
    Adaption adaption;
    const Stopwatch watch;
    method.front->begin_frame({&view, 1}, time_s);
    adaption.operations =
        lod::schedule(fronts, {.tolerance_px = tolerance_px}, lod::operation_limit(UINT64_MAX)).operations;
    const double before_us = watch.seconds() * 1e6;
    place_alone(method);
    const Stopwatch emission;
    method.front->emit(view, method.list);
    adaption.cpu_us = before_us + emission.seconds() * 1e6;
    return adaption;
}

std::vector<terrain::DrawnTriangle> triangles_of(Method& method) {
    method.pool.apply(method.list);
    return terrain::drawn_triangles(method.pool, method.list, lod::Module::kTerrain);
}

}  // namespace sim
