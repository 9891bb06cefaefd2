#include "sim/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/compare/statistics.h"
#include "sim/progress.h"

namespace sim {
namespace {

constexpr double kMega = 1e6;
constexpr double kMatrixTarget_px = 1.0;

/// What all methods share on the way.
struct Rig {
    const data::HeightGrid& grid;
    const CompareOptions& options;
    Sorties sorties;
    std::vector<Method> methods;
    render::Renderer renderer;
};

std::vector<Entrant> calibrate_all(Rig& rig, double target_px) {
    const std::vector<lod::View> views = calibration_views(rig.sorties);
    std::vector<Entrant> entrants;
    for (Method& method : rig.methods) {
        const Calibration found = calibrate(method, rig.grid, views, target_px, rig.options.methods.threads);
        say_progress(fmt::format("{}: tolerance {:.3f} px makes {:.3f} px, {} triangles", method.name,
                                 found.tolerance_px, found.measured_px, found.triangles));
        entrants.push_back({&method, found});
    }
    return entrants;
}

double pool_mb(const lod::PoolRegion& need) {
    return (static_cast<double>(need.vertex_capacity) * sizeof(lod::Vertex) +
            static_cast<double>(need.index_capacity) * sizeof(uint32_t)) /
           kMega;
}

CompareRow inspect_row(Rig& rig, const Entrant& entrant, double target_px) {
    Method& method = *entrant.method;
    CompareRow row;
    row.method = method.name;
    row.target_px = target_px;
    row.calibration = entrant.calibration;
    restart(method, entrant.calibration.tolerance_px, 0);
    row.inspection = inspect(method, rig.grid, rig.sorties.flight, entrant.calibration.tolerance_px);
    row.memory_mb = static_cast<double>(method.memory_bytes(*method.front)) / kMega;
    row.pool_mb = pool_mb(method.front->pool_need());
    row.prepare_s = method.prepare_s;
    return row;
}

lod::Result<lod::Ok> add_rows(Rig& rig, double target_px, std::vector<CompareRow>& rows) {
    std::vector<Entrant> entrants = calibrate_all(rig, target_px);
    const size_t first = rows.size();
    for (const Entrant& entrant : entrants) {
        rows.push_back(inspect_row(rig, entrant, target_px));
        say_progress(fmt::format("{}: inspected at {} px", entrant.method->name, target_px));
    }
    auto times = race(entrants, rig.sorties, rig.renderer);
    if (!times) return times.error();
    for (size_t i = 0; i < entrants.size(); ++i)
        rows[first + i].times = std::move((*times)[i]);
    return lod::Ok{};
}

const CompareRow* find_row(const std::vector<CompareRow>& rows, const std::string& method, double target_px) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const CompareRow& row) {
        return row.method == method && row.target_px == target_px;
    });
    return found == rows.end() ? nullptr : &*found;
}

RequirementRow requirements_of(Rig& rig, Method& method, const CompareRow& row, const CompareRow* roam) {
    const lod::View view = rig.sorties.flight.front();
    const PictureFigures picture = measure_picture(method, rig.grid, view, row.calibration.tolerance_px);
    const double spike = measure_spike(method.name, rig.grid, rig.options.methods);
    const double p50 = percentile(row.times.frame_ms, 0.5);
    RequirementRow out;
    out.method = method.name;
    if (roam != nullptr) out.figures[0] = row.inspection.triangles / roam->inspection.triangles;
    out.figures[1] = picture.t_junctions;
    out.figures[2] = picture.colour_beside_cells;
    if (spike >= 0.0) out.figures[3] = spike;
    if (p50 > 0.0) out.figures[4] = percentile(row.times.frame_ms, 0.99) / p50;
    out.figures[5] = row.inspection.acmr;
    out.figures[6] = row.inspection.changed_share;
    out.figures[7] = picture.off_limit_share;
    return out;
}

}  // namespace

lod::Result<Comparison> compare_methods(const data::HeightGrid& grid, const CompareOptions& options) {
    render::RendererOptions rendering;
    rendering.width_px = options.sorties.width_px;
    rendering.height_px = options.sorties.height_px;
    rendering.pool = {1, 3, 16};  // until the methods are placed
    auto renderer = render::Renderer::create(rendering);
    if (!renderer) return renderer.error();
    const Stopwatch watch;
    const terrain::DiamondTable table = terrain::make_diamond_table(grid, options.methods.threads);
    Rig rig{grid, options, plan_sorties(grid, options.sorties),
            make_methods(grid, table, watch.seconds(), options.methods), std::move(*renderer)};

    Comparison comparison{grid.width, grid.height, grid.frame.cell_m().x, {}, left_out(grid, options.methods),
                          {}};
    for (const double target_px : options.targets_px) {
        if (auto added = add_rows(rig, target_px, comparison.rows); !added) return added.error();
    }
    const double target_px = *std::min_element(
        options.targets_px.begin(), options.targets_px.end(),
        [](double a, double b) { return std::abs(a - kMatrixTarget_px) < std::abs(b - kMatrixTarget_px); });
    const CompareRow* roam = find_row(comparison.rows, "roam", target_px);
    for (Method& method : rig.methods) {
        const CompareRow* row = find_row(comparison.rows, method.name, target_px);
        comparison.requirements.push_back(requirements_of(rig, method, *row, roam));
    }
    return comparison;
}

}  // namespace sim
