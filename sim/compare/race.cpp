#include "sim/compare/race.h"

#include <algorithm>

#include "sim/progress.h"

namespace sim {
namespace {

constexpr int kWarmUpFrames = 3;
constexpr uint32_t kCommands = 65536;

/// Regions one behind the other, half as large again where they may grow; what is placed must be written anew.
lod::Result<lod::Ok> share_out(std::vector<Entrant>& entrants, std::vector<lod::PoolRegion>& regions,
                               render::Renderer& renderer) {
    render::PoolCapacity pool{0, 0, kCommands};
    regions.clear();
    for (Entrant& entrant : entrants) {
        Method& method = *entrant.method;
        const lod::PoolRegion need = method.front->pool_need();
        const uint32_t vertices = method.make ? need.vertex_capacity / 2 * 3 : need.vertex_capacity;
        method.region = {pool.vertices, vertices, pool.indices, need.index_capacity / 2 * 3};
        method.front->place(method.region);
        pool.vertices += method.region.vertex_capacity;
        pool.indices += method.region.index_capacity;
        regions.push_back(method.region);
    }
    return renderer.resize_pool(pool);
}

bool has_moved(const lod::PoolRegion& a, const lod::PoolRegion& b) {
    return a.vertex_capacity != b.vertex_capacity || a.index_capacity != b.index_capacity;
}

/// No sky, no colours: only the ground's triangles cost.
render::Atmosphere clear_air(const lod::View& view) {
    render::Atmosphere air = render::vacuum();
    air.up_world = air.sun_world = glm::transpose(view.eye_from_world)[1];
    return air;
}

struct FrameTimes {
    double cpu_us = 0.0, frame_ms = 0.0;
};

FrameTimes draw_frame(Entrant& entrant, const lod::View& view, double time_s, render::Renderer& renderer) {
    const render::Atmosphere air = clear_air(view);
    const Stopwatch watch;
    const Adaption adaption = adapt(*entrant.method, view, time_s, entrant.calibration.tolerance_px);
    renderer.draw(view, entrant.method->list, air);
    renderer.finish();
    return {adaption.cpu_us, watch.ms()};
}

lod::Result<lod::Ok> fly(std::vector<Entrant>& entrants, const Sorties& sorties, render::Renderer& renderer,
                         std::vector<RaceTimes>& times) {
    std::vector<lod::PoolRegion> regions;
    if (auto shared = share_out(entrants, regions, renderer); !shared) return shared.error();
    const int frames = static_cast<int>(sorties.flight.size());
    for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
        const lod::View& view = sorties.flight[static_cast<size_t>(std::max(frame, 0))];
        std::vector<FrameTimes> now(entrants.size());
        bool has_outgrown = false;
        for (size_t turn = 0; turn < entrants.size(); ++turn) {
            const size_t i = (turn + static_cast<size_t>(frame + kWarmUpFrames)) % entrants.size();
            now[i] = draw_frame(entrants[i], view, frame / kRate_hz, renderer);
            has_outgrown |= has_moved(entrants[i].method->region, regions[i]);
        }
        if (has_outgrown) {
            if (auto shared = share_out(entrants, regions, renderer); !shared) return shared.error();
            // Twice: what was written once and for all is given back with the frame after.
            for (size_t i = 0; i < 2 * entrants.size(); ++i)
                draw_frame(entrants[i % entrants.size()], view, frame / kRate_hz, renderer);
        }
        if (has_outgrown || frame < 0) continue;
        for (size_t i = 0; i < entrants.size(); ++i) {
            times[i].cpu_us.push_back(now[i].cpu_us);
            times[i].frame_ms.push_back(now[i].frame_ms);
        }
    }
    return lod::Ok{};
}

/// Adapts to one view after the other; returns what each cost each entrant.
std::vector<std::vector<Adaption>> jump(std::vector<Entrant>& entrants, const std::vector<lod::View>& views,
                                        double begin_s) {
    std::vector<std::vector<Adaption>> out(entrants.size());
    for (size_t k = 0; k < views.size(); ++k) {
        for (size_t i = 0; i < entrants.size(); ++i) {
            const double time_s = begin_s + static_cast<double>(k + 1) / kRate_hz;
            out[i].push_back(
                adapt(*entrants[i].method, views[k], time_s, entrants[i].calibration.tolerance_px));
        }
    }
    return out;
}

}  // namespace

lod::Result<std::vector<RaceTimes>> race(std::vector<Entrant>& entrants, const Sorties& sorties,
                                         render::Renderer& renderer) {
    std::vector<RaceTimes> times(entrants.size());
    for (Entrant& entrant : entrants) {
        const Calibration& at = entrant.calibration;
        restart(*entrant.method, at.tolerance_px, 2 * at.triangles);
        adapt(*entrant.method, sorties.flight.front(), -1.0, at.tolerance_px);
    }
    if (auto flown = fly(entrants, sorties, renderer, times); !flown) return flown.error();
    const double flight_s = static_cast<double>(sorties.flight.size()) / kRate_hz;
    const auto turns = jump(entrants, sorties.turns, flight_s);
    const auto teleports = jump(entrants, sorties.teleports, flight_s + 1.0);
    for (size_t i = 0; i < entrants.size(); ++i) {
        for (const Adaption& turn : turns[i]) {
            times[i].turn_us.push_back(turn.cpu_us);
            times[i].turn_operations.push_back(static_cast<double>(turn.operations));
        }
        for (const Adaption& teleport : teleports[i])
            times[i].teleport_us.push_back(teleport.cpu_us);
        entrants[i].method->region = {};  // what comes next places it for itself
    }
    return times;
}

}  // namespace sim
