// ProgressiveBlock: a view-independent progressive mesh of one block: its coarsest triangles and the sequence of
// vertex splits that leads back to every sample, always applied in the same order.
//
// Vertices and triangles are numbered in the order in which splits bring them, so the active ones are the first
// of their arrays; a split activates the next vertex and one or two triangles, and puts the new vertex in the
// place of the old one in a few active triangles. The inverse is an edge collapse.
// Sources: Hoppe, Progressive Meshes (1996); Elykov, Lavrentiev et al. (Softlab-NSK), section 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/height_grid.h"
#include "terrain/diamond.h"

namespace terrain {

struct ProgressiveBlock {
    /// Cells from the block's north-west sample.
    struct Place {
        uint8_t x = 0, y = 0;
    };
    struct Split {
        uint16_t vertex = 0;     ///< the one that is split
        uint16_t fix_count = 0;  ///< triangles in which the new vertex takes its place
    };
    /// A place in the sequence where a front may stand.
    struct Stop {
        uint32_t splits = 0, fixes = 0;          ///< done so far
        uint32_t triangles = 0;                  ///< active
        float error_m = 0.0f;                    ///< true maximum, whatever fans the neighbours ask for
        std::array<uint8_t, 4> border_shift{};   ///< [side] border vertices lie on multiples of 1 << this
        std::array<uint8_t, 4> border_points{};  ///< [side] active vertices between the corners
    };

    GridPoint origin, size;                        ///< north-west sample; cells along x and y, at most 64
    std::vector<Place> places;                     ///< [vertex]
    std::vector<std::array<uint16_t, 3>> corners;  ///< [triangle]; the inactive as they were when last active
    std::vector<Split> splits;
    std::vector<uint16_t> fixes;       ///< triangles, split after split
    std::vector<uint16_t> rim_vertex;  ///< [side * 65 + position along it]
    std::vector<Stop> stops;           ///< coarsest first; the last is the source itself
    uint32_t base_vertices = 0;        ///< active before the first split

    uint16_t vertex_on_side(int side, int position) const {
        return rim_vertex[static_cast<size_t>(side * 65 + position)];
    }
    GridPoint place(uint16_t vertex) const { return {places[vertex].x, places[vertex].y}; }

    /// Moves the active mesh between two stops; returns the number of splits or collapses.
    uint32_t move(const Stop& from, const Stop& to);

    uint64_t memory_bytes() const;
};

/// Collapses the block's vertices in the order of the error that each brings, as far as possible; errors are exact
/// maxima over all covered samples. Border vertices go by powers of two, corners stay.
/// @param origin  the block's north-west sample @param size  cells along x and y, 1 … 64
/// Cost: about 5 us per sample.
ProgressiveBlock make_progressive_block(const data::HeightGrid& grid, GridPoint origin, GridPoint size);

}  // namespace terrain
