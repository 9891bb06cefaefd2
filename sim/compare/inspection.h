// inspect: what a method draws along a flight, read from its draw lists: counts, bytes, changes, jumps. No clock.
#pragma once

#include <span>

#include "sim/compare/method.h"

namespace sim {

struct Inspection {
    double triangles = 0.0;      ///< drawn, mean
    double cut_triangles = 0.0;  ///< in view or not, mean
    double commands = 0.0;       ///< draw items, mean
    double upload_bytes = 0.0;   ///< mean, without the first frame
    double changed_share = 0.0;  ///< mean
    double popping_px = 0.0;     ///< largest
    double told_px = 0.0;        ///< the largest jump the front itself tells of; 0 when it does not say
    double acmr = 0.0;           ///< vertices fetched a triangle, 16-entry first-in first-out cache, mean
};

/// Flies, adapting in every frame until nothing is left to do. Each frame is compared with the one before.
Inspection inspect(Method& method, const data::HeightGrid& grid, std::span<const lod::View> flight,
                   double tolerance_px);

/// Vertices fetched a triangle when the last `size` fetched are kept.
double cache_misses_a_triangle(const terrain::PoolTwin& pool, const lod::DrawList& list, size_t size);

/// What a list writes into the pool.
uint64_t upload_bytes(const lod::DrawList& list);

}  // namespace sim
