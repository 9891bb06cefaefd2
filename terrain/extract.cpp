#include "terrain/extract.h"

#include <algorithm>

#include "terrain/diamond_table.h"
#include "terrain/leaf_cover.h"

namespace terrain {
namespace {

/// Splits a diamond and, before it, whatever it needs.
void split_with_parents(DiamondMesh& mesh, DiamondIndex index, std::vector<DiamondIndex>& chain) {
    chain.assign(1, index);
    while (!chain.empty()) {
        const DiamondIndex missing = mesh.missing_parent(chain.back());
        if (missing != kOutside) {
            chain.push_back(missing);
        } else {
            mesh.split(chain.back());
            chain.pop_back();
        }
    }
}

/// Splits until every leaf is good enough. Errors are saturated, so top-down finds them all.
void refine_to(DiamondMesh& mesh, const DiamondTable& table, float max_error_m) {
    std::vector<DiamondIndex> open{kRoot}, chain;
    std::vector<bool> is_seen;  // [record]: most are reached from two parents
    while (!open.empty()) {
        const DiamondIndex index = open.back();
        open.pop_back();
        is_seen.resize(mesh.record_count());
        if (is_seen[index]) continue;
        is_seen[index] = true;
        const Diamond d = mesh[index];
        if (table.at(d.centre(), d.level).error_m() <= max_error_m) continue;
        if (!d.is_split) split_with_parents(mesh, index, chain);
        for (int side = 0; side < 4; ++side) {
            const DiamondIndex child = mesh.child(index, side);
            if (child != kOutside) open.push_back(child);
        }
    }
}

/// Numbers the corners of drawn leaves and keeps the worst leaf's error.
struct Collector {
    struct State {};

    const data::HeightGrid& grid;
    const DiamondTable& table;
    const DiamondMesh& mesh;
    LeafCover cover;
    ExtractedMesh& out;
    std::vector<uint32_t> number;  ///< [record], UINT32_MAX: not yet

    bool enter(DiamondIndex, State&) const { return true; }

    void leaf(const Leaf& leaf, const Diamond* diamond, int half) {
        if (!cover.is_drawn(leaf, diamond, half)) return;
        if (diamond != nullptr) {
            out.max_error_m =
                std::max(out.max_error_m, double(table.at(diamond->centre(), diamond->level).error_m()));
        }
        out.triangles.push_back({vertex(leaf.apex), vertex(leaf.right), vertex(leaf.left)});
    }

    uint32_t vertex(DiamondIndex record) {
        uint32_t& n = number[record];
        if (n == UINT32_MAX) {
            n = static_cast<uint32_t>(out.vertices.size());
            const GridPoint p = mesh.domain().clamped(mesh[record].centre());
            out.vertices.push_back({p.x, p.y, grid.at(p.x, p.y)});
        }
        return n;
    }
};

}  // namespace

ExtractedMesh extract(const data::HeightGrid& grid, double max_error_m, unsigned threads) {
    // The same heights in a plane: errors without the Earth's curvature. Cells as wide as this make the rim of a
    // hole, whose error is the length of its triangles, exact at any tolerance.
    constexpr double kSpacing_m = 1e5;
    data::HeightGrid plane = data::make_planar_grid(grid.width, grid.height, kSpacing_m, grid.height_m);
    plane.is_void = grid.is_void;
    const DiamondTable table = make_diamond_table(plane, threads);
    DiamondMesh mesh(table.domain);
    refine_to(mesh, table, static_cast<float>(max_error_m));
    ExtractedMesh out;
    Collector collector{plane, table, mesh, {plane, table, mesh}, out, {}};
    collector.number.assign(mesh.record_count(), UINT32_MAX);
    LeafWalk(mesh, collector).run({});
    return out;
}

}  // namespace terrain
