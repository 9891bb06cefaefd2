// Method: one way to draw a terrain, prepared once over one grid, with the buffers that what it draws is read from.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "data/height_grid.h"
#include "lod/front.h"
#include "terrain/diamond_table.h"
#include "terrain/drawn/drawn_mesh.h"

namespace sim {

/// ROAM's ways: vertices that glide to their places, or jump there.
inline constexpr double kGlide_s = 0.4;

struct Method {
    /// A front for one tolerance, px, and for this many triangles without allocating. Empty when one front serves all.
    using Make = std::function<std::unique_ptr<lod::Front>(double tolerance_px, uint64_t triangles)>;

    std::string name;        ///< snake_case, for tables
    double prepare_s = 0.0;  ///< from the grid to the coarsest mesh
    bool has_skirts = false;
    Make make;
    std::function<uint64_t(const lod::Front&)> memory_bytes;  ///< tables included, grid and geometry pool not
    std::unique_ptr<lod::Front> front;
    lod::PoolRegion region;  ///< where the front was last placed
    terrain::PoolTwin pool;  ///< what a renderer would hold of it
    lod::DrawList list;      ///< of the last frame
};

/// Which methods are compared.
struct MethodOptions {
    unsigned threads = 1;           ///< of the preparation
    int block_cells = 32;           ///< of the methods made of blocks
    std::vector<std::string> only;  ///< names; empty: all
};

/// A method that cannot be prepared for a grid.
struct LeftOut {
    std::string name, reason;
};
std::vector<LeftOut> left_out(const data::HeightGrid& grid, const MethodOptions& options);

/// All methods over one grid that can be prepared for it, prepared one after the other: ROAM with and without gliding, then the rivals.
/// @param grid, table  must outlive them; the table is the grid's
/// @param table_s      what making the table took
std::vector<Method> make_methods(const data::HeightGrid& grid, const terrain::DiamondTable& table,
                                 double table_s, const MethodOptions& options);

/// Gives a method the coarsest mesh it has, made for this tolerance.
void restart(Method& method, double tolerance_px, uint64_t triangles);

/// What one frame's adaption cost.
struct Adaption {
    double cpu_us = 0.0;  ///< begin_frame, schedule and emit
    uint64_t operations = 0;
};

/// Adapts to a view until nothing is left to do, and fills `list`. A front that outgrew its region is placed anew
/// in a region that begins at 0.
Adaption adapt(Method& method, const lod::View& view, double time_s, double tolerance_px);

/// The triangles of the last frame.
std::vector<terrain::DrawnTriangle> triangles_of(Method& method);

}  // namespace sim
