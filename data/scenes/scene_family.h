// Families of generated scenes: how many objects of what complexity, how sparse in space, how eventful and how coherent
// in space and time.
//
// Objects fill cells of buildings; when each appears follows a Hilbert curve through all cells, as far as coherence goes.
//
//   high-rise   one tower, four times as high as wide
//   group       small buildings of 8 x 8 x 5 cells with streets between
//   scattered   a cube filled in any order: coherence counts for nothing
//
// Source: Gonakhchyan (2021), section 3.4 (families of dynamic scenes, erection along space-filling curves). Measures of
// the parameters are our own.
#pragma once

#include <cstdint>

#include "data/timed_scene.h"

namespace data {

enum class SceneFamily : uint8_t { kHighRise, kGroup, kScattered };

struct FamilyOptions {
    SceneFamily family = SceneFamily::kHighRise;
    uint64_t seed = 0;
    uint32_t objects = 10000;  ///< 1 to 10^7
    uint32_t triangles = 60;   ///< of each object, 12 to 10^5
    double sparsity = 0.0;     ///< [0, 1): share of a building's cells that stay empty
    double events_per_object =
        1.0;                    ///< [0, 100], mean: at 0 all is static, at 1 everything appears once; of a
                                ///< fraction each object has its whole part, and one more with that chance
    double coherence = 1.0;     ///< [0, 1]: 1 follows the curve, 0 is any order
    double moving_share = 0.0;  ///< [0, 1]: share of objects that are lifted to their places in sight
    double end_s = 600.0;       ///< > 0
};

/// Exactly `objects` objects of exactly `triangles` triangles each, over at most eight shared meshes; cells are 4 m wide,
/// the ground is z = 0. Events lie within (0, T). CHECKs the ranges above.
/// Deterministic. Cost: O(n log n); a million objects in half a second and 210 MB (docs/objects.md).
TimedScene generate_family(const FamilyOptions& options);

}  // namespace data
