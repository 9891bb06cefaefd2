// batch_errors: a diamond table for leaves that are drawn as 4^k triangles each.
//
//     k = 0   ◣      k = 1   ◣◣      A leaf is bisected 2k levels deeper than the mesh, everywhere alike, over the
//                            ◣       true samples: conforming because the mesh is, and as good as its finest triangles.
//
// So a diamond's error becomes the largest of those that its two triangles are drawn as: 0 where the grid ends before.
// Saturated as before. What its sphere contains does not change, so its rise takes up what its error gives up.
#pragma once

#include "terrain/diamond_table.h"

namespace terrain {

inline constexpr int kMostBatch = 3;

/// @param table    all pages present
/// @param batch    k in 0 … kMostBatch
/// @param threads  >= 1; the result does not depend on it
/// Cost: O(n), about a quarter of what the table itself takes.
void batch_errors(DiamondTable& table, int batch, unsigned threads);

}  // namespace terrain
