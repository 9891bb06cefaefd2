// Stand-ins: a part that is nearly a prism is one of few sides, a sheet, or a single face.
//
//       ___                                                             .
//     /     \         ______         _____                             / \        .
//    |\ ___ /|       |\____/|       |\___/|        +-----+            /   \       the more it may be off,
//    | |   | |       ||    ||       | | | |        |     |           /     \      the fewer faces
//    |_|___|_|       ||____||        \|_|/         +-----+          /_______\     .
//     prism of 12     box            of 3          sheet            spike
//     44 faces        12             8             2                1
//
// Contraction cuts corners one by one and only outwards, so it comes late from one of these to the next; here the next is
// proposed as a whole and proved. Prisms are closed. Between boxes and spikes are tents, a roof on leaning walls, and pairs of
// leaning faces. A spike stands for a part that is nowhere farther from its axis than the limit, and covers as much as the part
// seen from the side, as far as the limit allows. Sheets, spikes and pairs lean, foot one way and head the other, as far as it allows:
// so they show from above, too. Faces that share no corners are gathered with their neighbours' (gather.h).
#pragma once

#include <span>
#include <vector>

#include "lod/surface/triangle_tree.h"
#include "objects/reduction/face_loads.h"
#include "objects/reduction/face_soup.h"

namespace objects {

struct StandIn {
    FaceSoup soup;         ///< in one colour
    bool is_card = false;  ///< twisted; should not be merged with others: both would be too broad
    FaceSoup to_gather;  ///< single faces that would do, too: best gathered with others' (gather.h); or none
};

/// @param part     any soup; one in one piece and convex is worth asking for
/// @param limit_m  > 0
/// @returns        a soup whose Hausdorff distance to `part` is proved to be at most `limit_m`, with the
///                 fewest faces of those tried and fewer than `part`; without faces when none is
/// Cost: O(n log n), 1 to 10 us a face. Deterministic.
StandIn stand_in(const FaceSoup& part, double limit_m);

/// Every part of a soup by its stand-in where there is one, else as it is.
struct StandIns {
    FaceSoup soup;
    FaceSoup to_grow;  ///< the same, but slender parts as they are: what grows together best
    std::vector<uint32_t> part_of_source;  ///< [faces of the source]
    std::vector<std::vector<uint32_t>>
        faces_of_part;                 ///< [parts] of `soup`; gathered ones are several parts'
    std::vector<uint8_t> is_replaced;  ///< [parts]
    std::vector<FaceSoup> of_part;     ///< [parts] before any are gathered
    std::vector<FaceLoad> to_gather;   ///< by itself each would do
    bool are_gathered = false;         ///< those of them that were to be

    size_t part_count() const { return is_replaced.size(); }
};

/// @param cell_m   > 0; points that near to each other hold a part together
/// @param threads  at least 1; the result is the same for any
StandIns stand_ins(const FaceSoup& source, double limit_m, double cell_m, unsigned threads);

/// Neighbours' stand-ins become one for all of them where that will do.
/// @param source_tree  of the source
/// @param is_wanted    [parts] 0: it stays as it is
/// @param parts        of it, none gathered yet; in and out: `soup` and `faces_of_part` change
void gather_stand_ins(const FaceSoup& source, const lod::TriangleTree& source_tree, double limit_m,
                      std::span<const uint8_t> is_wanted, unsigned threads, StandIns& parts);

}  // namespace objects
