#include "terrain/extract.h"

#include <algorithm>

#include "lod/base/check.h"
#include "terrain/sample_set.h"
#include "terrain/triangle_misfit.h"

namespace terrain {
namespace {

/// A place in the bintree: the diamond, and which of its two apexes where one triangle is meant.
struct Place {
    GridPoint centre;
    int16_t level = 0;
    int16_t half = 0;
};

TriangleCorners corners_of(const Domain& domain, const Place& place) {
    const int reach = domain.reach(place.level);
    const int dir = apex_direction(domain, place.centre, place.level) + 4 * place.half;
    return {step_from(place.centre, dir, reach), step_from(place.centre, dir + 2, reach),
            step_from(place.centre, dir - 2, reach)};
}

/// The bintree while it is refined: a mesh is the set of its split diamonds.
class Refinement {
  public:
    Refinement(const data::HeightGrid& grid, const Domain& domain)
        : grid_(grid), domain_(domain), split_(domain.side() + 1, domain.side() + 1) {}

    /// Splits until no triangle is farther than this from a sample.
    void run(double max_error_m) {
        const int middle = domain_.side() / 2;
        open_ = {{{middle, middle}, 0, 0}, {{middle, middle}, 0, 1}};
        while (!open_.empty()) {
            const Place place = open_.back();
            open_.pop_back();
            if (split_.has(place.centre)) continue;  // forced meanwhile: its children are open
            const TriangleCorners corners = corners_of(domain_, place);
            if (triangle_misfit(grid_, domain_, corners, max_error_m) > max_error_m)
                split_with_parents(place);
        }
    }

    bool is_split(GridPoint centre) const { return split_.has(centre); }

  private:
    /// Splits a diamond and, before it, whatever it needs.
    void split_with_parents(const Place& place) {
        chain_.assign(1, place);
        while (!chain_.empty()) {
            const Place next = chain_.back();
            const size_t length = chain_.size();
            for (int16_t half = 0; half < 2 && next.level > 0; ++half) {
                const GridPoint parent = corners_of(domain_, {next.centre, next.level, half}).apex;
                if (domain_.contains(parent) && !split_.has(parent)) {
                    chain_.push_back({parent, static_cast<int16_t>(next.level - 1), 0});
                }
            }
            if (chain_.size() > length) continue;
            chain_.pop_back();
            if (!split_.has(next.centre)) split(next);
        }
    }

    /// The four triangles that appear are open.
    void split(const Place& place) {
        split_.add(place.centre);
        if (place.level == domain_.finest_level()) return;  // halves of cells cover nothing but their corners
        const int apex_dir = apex_direction(domain_, place.centre, place.level);
        const auto level = static_cast<int16_t>(place.level + 1);
        for (int side = 0; side < 4; ++side) {
            const int dir = apex_dir + 2 * side + 1;
            const GridPoint child = step_from(place.centre, dir, domain_.child_step(place.level));
            if (!domain_.contains(child)) continue;
            const bool is_first = ((dir + 4) & 7) == apex_direction(domain_, child, level);
            open_.push_back({child, level, static_cast<int16_t>(is_first ? 0 : 1)});
        }
    }

    const data::HeightGrid& grid_;
    const Domain domain_;
    SampleSet split_;
    std::vector<Place> open_, chain_;
};

/// Visits the leaves in Sierpinski order.
template <typename Visit>
void walk(const Refinement& tree, int levels_below, const TriangleCorners& t, const Visit& visit) {
    const GridPoint middle{(t.left.x + t.right.x) / 2, (t.left.y + t.right.y) / 2};
    if (levels_below == 0 || !tree.is_split(middle)) {
        visit(t, levels_below == 0);
        return;
    }
    walk(tree, levels_below - 1, {middle, t.apex, t.left}, visit);
    walk(tree, levels_below - 1, {middle, t.right, t.apex}, visit);
}

/// A leaf in the raster; false when nothing is left of it, or no height is known there. A leaf larger than half a
/// cell is void as a whole or not at all.
bool is_drawn(const data::HeightGrid& grid, const TriangleCorners& t) {
    const bool has_area = int64_t{t.left.x - t.apex.x} * (t.right.y - t.apex.y) !=
                          int64_t{t.right.x - t.apex.x} * (t.left.y - t.apex.y);
    return has_area && !grid.void_at(t.apex.x, t.apex.y) && !grid.void_at(t.left.x, t.left.y) &&
           !grid.void_at(t.right.x, t.right.y);
}

/// The leaves that are drawn, corners clamped into the raster.
template <typename Visit>
void walk_drawn(const data::HeightGrid& grid, const Domain& domain, const Refinement& tree,
                const Visit& visit) {
    const int middle = domain.side() / 2;
    for (int16_t half = 0; half < 2; ++half) {
        const TriangleCorners root = corners_of(domain, {{middle, middle}, 0, half});
        walk(tree, domain.finest_level() + 1, root, [&](const TriangleCorners& leaf, bool is_half_cell) {
            const TriangleCorners t{domain.clamped(leaf.apex), domain.clamped(leaf.left),
                                    domain.clamped(leaf.right)};
            if (is_drawn(grid, t)) visit(t, is_half_cell);
        });
    }
}

}  // namespace

ExtractedMesh extract(const data::HeightGrid& grid, double max_error_m) {
    CHECK(grid.width >= 2 && grid.height >= 2 && grid.width <= 32769 && grid.height <= 32769);
    const Domain domain = make_domain(grid.width, grid.height);
    Refinement tree(grid, domain);
    tree.run(max_error_m);

    ExtractedMesh mesh;
    SampleSet used(grid.width, grid.height);
    size_t triangle_count = 0;
    walk_drawn(grid, domain, tree, [&](const TriangleCorners& t, bool is_half_cell) {
        for (GridPoint p : {t.apex, t.left, t.right})
            used.add(p);
        ++triangle_count;
        if (is_half_cell) return;
        mesh.max_error_m = std::max(mesh.max_error_m, triangle_misfit(grid, domain, t, max_error_m));
    });
    used.number_members();
    mesh.vertices.resize(used.count());
    mesh.triangles.reserve(triangle_count);
    walk_drawn(grid, domain, tree, [&](const TriangleCorners& t, bool) {
        for (GridPoint p : {t.apex, t.left, t.right})
            mesh.vertices[used.number(p)] = {p.x, p.y, grid.at(p.x, p.y)};
        mesh.triangles.push_back({used.number(t.apex), used.number(t.right), used.number(t.left)});
    });
    return mesh;
}

}  // namespace terrain
