// DiamondMesh: the set of split diamonds and the candidates around it, with the two elementary operations.
//
// Records live in one pool; kinship is by index, so neither operation searches or hashes. A record exists for
// every split diamond and for every diamond that could be split next (one parent or both split). A leaf triangle
// is a pair (unsplit diamond, split parent). 20 bytes a record, 16 more for the children of a split one.
//
// Invariants (terrain/validate.h proves them): a split diamond's parents are split; children link back; the mesh
// has no T-junction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/diamond.h"

namespace terrain {

using DiamondIndex = uint32_t;

/// Bits of an index in a record: 134 million records, about 100 million triangles.
inline constexpr uint32_t kIndexBits = 27;
inline constexpr DiamondIndex kOutside =
    (1u << kIndexBits) - 1;                             ///< beyond the domain, or finer than the grid
inline constexpr DiamondIndex kUnsplit = kOutside - 1;  ///< parent place whose diamond is not split
inline constexpr DiamondIndex kCornerCount = 4;         ///< records 0..3: the domain's corners, always there
inline constexpr DiamondIndex kRoot = 4;                ///< record of the one diamond of level 0

inline constexpr uint32_t kNoKids = 0;  ///< block of an unsplit diamond's children: all kOutside

inline bool is_record(DiamondIndex index) {
    return index < kUnsplit;
}

inline constexpr uint32_t kFreeLevel = 63;

inline constexpr uint32_t kMostCoordinate = (1u << 23) - 1;  ///< that a record holds
static_assert((1u << kMostLog2Side) <= kMostCoordinate);

/// One diamond, packed: its size is a third of what the mesh takes. `bucket`, `queue` and `stamp` belong to whoever
/// ranks the diamonds; the mesh only clears them.
struct Diamond {
    uint32_t x : 23 = 0;        ///< of the centre
    uint32_t level : 6 = 0;     ///< kFreeLevel: on the free list
    uint32_t apex_dir : 3 = 0;  ///< 0 … 7, diamond.h
    uint32_t y : 23 = 0;        ///< of the centre
    uint32_t is_split : 1 = 0;
    uint32_t bucket : 8 = 0;
    uint32_t parent0 : 27 = kOutside;  ///< lies in `apex_dir`
    uint32_t slot0 : 2 = 0;            ///< this record's place among parent 0's children
    uint32_t queue : 3 = 0;
    uint32_t parent1 : 27 = kOutside;  ///< lies opposite
    uint32_t slot1 : 2 = 0;            ///< this record's place among parent 1's children
    uint32_t split_kids : 3 = 0;       ///< children that are split
    uint32_t kids : 27 = kNoKids;      ///< block of four child indices
    uint32_t stamp : 5 = 0;

    void set_centre(GridPoint centre) {
        x = static_cast<uint32_t>(centre.x) & kMostCoordinate;
        y = static_cast<uint32_t>(centre.y) & kMostCoordinate;
    }
    GridPoint centre() const { return {static_cast<int>(x), static_cast<int>(y)}; }

    bool is_used() const { return level != kFreeLevel; }

    std::array<DiamondIndex, 2> parents() const { return {parent0, parent1}; }
    DiamondIndex parent(uint32_t which) const { return which == 0 ? parent0 : parent1; }
    uint32_t slot(uint32_t which) const { return which == 0 ? slot0 : slot1; }
    /// @param side  of the parent's, that this record lies on
    void set_parent(uint32_t which, DiamondIndex index, uint32_t side) {
        if (which == 0) {
            parent0 = index & kOutside;
            slot0 = side & 3;
        } else {
            parent1 = index & kOutside;
            slot1 = side & 3;
        }
    }
};

/// Records that a split made, for whoever ranks them.
struct SplitOutcome {
    std::array<DiamondIndex, 4> created{};
    uint32_t created_count = 0;
    std::array<DiamondIndex, 2> no_longer_mergeable{};  ///< parents that just got their first split child
    uint32_t no_longer_mergeable_count = 0;
};

/// Records that a merge removed.
struct MergeOutcome {
    std::array<DiamondIndex, 4> removed{};
    uint32_t removed_count = 0;
    std::array<DiamondIndex, 2> mergeable{};  ///< parents that just lost their last split child
    uint32_t mergeable_count = 0;
};

static_assert(sizeof(Diamond) == 20);

class DiamondMesh {
  public:
    explicit DiamondMesh(const Domain& domain);

    const Domain& domain() const { return domain_; }
    const Diamond& operator[](DiamondIndex index) const { return diamonds_[index]; }
    void set_queue(DiamondIndex index, uint8_t queue) { diamonds_[index].queue = queue & 7; }
    void set_rank(DiamondIndex index, uint8_t bucket, uint8_t stamp) {
        diamonds_[index].bucket = bucket;
        diamonds_[index].stamp = stamp & 31;
    }
    /// Records ever in use; indices are below this.
    uint32_t record_count() const { return static_cast<uint32_t>(diamonds_.size()); }
    /// Records in use now, without the corners.
    uint32_t live_count() const {
        return record_count() - kCornerCount - static_cast<uint32_t>(free_.size());
    }
    /// Leaf triangles, squeezed ones beyond the raster's border included.
    uint64_t triangles() const { return triangles_; }
    /// XOR of mix64 over all split diamonds.
    uint64_t hash() const { return hash_; }

    DiamondIndex child(DiamondIndex index, int side) const {
        return kids_[diamonds_[index].kids][static_cast<size_t>(side & 3)];
    }

    /// The parent that must be split before `index` can be; kOutside when there is none missing.
    DiamondIndex missing_parent(DiamondIndex index) const;

    /// The vertices at the ends of the edge that splitting this diamond cuts. Cost: two steps up on average, one a
    /// level at most.
    std::array<DiamondIndex, 2> edge_ends(DiamondIndex index) const;

    /// Splits a candidate whose parents are all split. Cost: about 40 ns.
    SplitOutcome split(DiamondIndex index);

    /// Merges a split diamond without split children.
    MergeOutcome merge(DiamondIndex index);

    /// Back to two triangles; keeps its memory. Cost: none to speak of.
    void clear();

    /// Starts loading a record, or what splitting it will read.
    void fetch(DiamondIndex index) const { __builtin_prefetch(&diamonds_[index]); }
    void fetch_kin(DiamondIndex index) const;

    /// Orders the free records and blocks by address, so that what is made next lies together in memory: worth
    /// its time after much has been merged at once. Cost: O(record_count()), about 2 ns a record.
    void tidy();

    /// Reserves memory so that no operation allocates below this many triangles.
    void reserve(uint64_t triangle_count);

  private:
    DiamondIndex add_record(const Diamond& d);
    void free_record(DiamondIndex index);
    DiamondIndex shared_child(const Diamond& d, uint32_t side) const;
    bool is_inside(GridPoint p) const;
    void share_child(DiamondIndex child, DiamondIndex index, uint32_t side);
    DiamondIndex make_child(const Diamond& parent, DiamondIndex index, uint32_t side, GridPoint centre);
    uint32_t make_kids(DiamondIndex index, SplitOutcome& outcome);
    DiamondIndex corner_at(DiamondIndex index, GridPoint point) const;
    bool drop_child(DiamondIndex child_index, DiamondIndex parent_index);

    Domain domain_;
    std::vector<Diamond> diamonds_;
    std::vector<std::array<DiamondIndex, 4>> kids_;
    std::vector<DiamondIndex> free_;
    std::vector<uint32_t> free_kids_;
    std::vector<uint8_t> is_block_used_;  ///< scratch of tidy()
    uint64_t triangles_ = 2;
    uint64_t hash_ = 0;
};

}  // namespace terrain
