// DiamondRank: what ranks a record of the mesh: its facts, copied from the table so that a page may go while the
// record stays, and its place in a queue.
#pragma once

#include "lod/bucket_queue.h"
#include "terrain/diamond_table.h"

namespace terrain {

struct DiamondRank {
    DiamondSource source;
    lod::BucketLink link;
};
static_assert(sizeof(DiamondRank) == 16);

}  // namespace terrain
