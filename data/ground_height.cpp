#include "data/ground_height.h"

#include <algorithm>
#include <cmath>

namespace data {
namespace {

/// Fractions at which a coordinate that runs from `a` to `b` meets multiples of `spacing`.
void append_multiples(double a, double b, double spacing, std::vector<double>& out) {
    const double first = std::ceil(std::min(a, b) / spacing), last = std::floor(std::max(a, b) / spacing);
    for (double multiple = first; multiple <= last; multiple += 1.0) {
        const double fraction = (multiple * spacing - a) / (b - a);
        if (fraction > 0.0 && fraction < 1.0) out.push_back(fraction);
    }
}

}  // namespace

// Cells are cut along the diagonal of their even corners, so each half has its right angle at an odd one.
HalfCell half_cell_at(const HeightGrid& grid, double col, double row) {
    const glm::ivec2 cell(std::min(static_cast<int>(col), grid.width - 2),
                          std::min(static_cast<int>(row), grid.height - 2));
    double u = col - cell.x, v = row - cell.y;
    const bool is_even = (cell.x + cell.y) % 2 == 0;  // the cut runs from the north-west to the south-east
    const bool from_east = is_even ? u > v : u + v > 1.0;
    const bool from_south = is_even ? !from_east : from_east;
    HalfCell half;
    half.corner = cell + glm::ivec2(from_east, from_south);
    half.along_row = {cell.x + !from_east, half.corner.y};
    half.along_col = {half.corner.x, cell.y + !from_south};
    half.u = from_east ? 1.0 - u : u;
    half.v = from_south ? 1.0 - v : v;
    return half;
}

GroundHeight ground_height(const HeightGrid& grid, double col, double row) {
    if (!is_inside(grid, col, row)) return {};
    const HalfCell half = half_cell_at(grid, col, row);
    const double corner_m = double{grid.at(half.corner.x, half.corner.y)};
    const double row_m = double{grid.at(half.along_row.x, half.along_row.y)};
    const double col_m = double{grid.at(half.along_col.x, half.along_col.y)};
    const bool is_void = grid.void_at(half.corner.x, half.corner.y) ||
                         grid.void_at(half.along_row.x, half.along_row.y) ||
                         grid.void_at(half.along_col.x, half.along_col.y);
    return {corner_m + half.u * (row_m - corner_m) + half.v * (col_m - corner_m), !is_void};
}

GroundHeight ground_height(const HeightGrid& grid, const SitePoint& site) {
    const glm::dvec2 place = grid.frame.grid_from_site(site);
    return ground_height(grid, place.x, place.y);
}

void mesh_crossings(const glm::dvec2& a, const glm::dvec2& b, std::vector<double>& out) {
    constexpr double kSame = 1e-9;  // fractions nearer than this are one crossing
    out.clear();
    append_multiples(a.x, b.x, 1.0, out);
    append_multiples(a.y, b.y, 1.0, out);
    append_multiples(a.x - a.y, b.x - b.y, 2.0, out);
    append_multiples(a.x + a.y, b.x + b.y, 2.0, out);
    std::sort(out.begin(), out.end());
    const auto same = [](double left, double right) { return right - left < kSame; };
    out.erase(std::unique(out.begin(), out.end(), same), out.end());
}

}  // namespace data
