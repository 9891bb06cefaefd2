// ClusterCut: the clusters a front holds, in one dense array; and CutQueue, which of them to work on next.
#pragma once

#include <cstdint>
#include <vector>

#include "lod/base/hash.h"
#include "objects/presence.h"

namespace objects {

/// A cluster of the cut, or above it. 40 bytes.
struct CutRecord {
    ClusterId id = kNoCluster;
    bool is_refined : 1 = false;   ///< its children stand for it
    bool is_seen : 1 = false;      ///< in view of some eye, by its box, and not hidden from it
    bool is_hidden : 1 = false;    ///< from some eye, behind solids of others
    bool is_occluder : 1 = false;  ///< its solids hide others
    bool has_event : 1 = false;    ///< its presence was looked up in this frame
    Presence presence;             ///< v_c now
    double error_px = 0.0;  ///< of this cluster if it were drawn; 0 when nothing of it is there or in view

    bool is_drawn() const { return !is_refined && is_seen && presence.share >= 0.5; }
};
static_assert(sizeof(CutRecord) == 40);

/// An active cluster's part in a cut's hash, which is the sum: no order shows.
constexpr uint64_t cluster_hash(ClusterId id) {
    return lod::mix64(uint64_t{id} + 0x517cc1b727220a95u);
}

/// Records in no particular order, found by cluster in O(1). 4 bytes a cluster of the tree, and the records.
class ClusterCut {
  public:
    explicit ClusterCut(size_t cluster_count) : slot_of_(cluster_count, kNoSlot) {}

    size_t size() const { return records_.size(); }
    bool holds(ClusterId id) const { return slot_of_[id] != kNoSlot; }
    CutRecord& at(ClusterId id) { return records_[slot_of_[id]]; }
    const CutRecord& at(ClusterId id) const { return records_[slot_of_[id]]; }

    CutRecord& add(ClusterId id) {
        slot_of_[id] = static_cast<uint32_t>(records_.size());
        records_.push_back({});
        records_.back().id = id;
        return records_.back();
    }
    void remove(ClusterId id) {
        const uint32_t slot = slot_of_[id];
        records_[slot] = records_.back();
        slot_of_[records_[slot].id] = slot;
        records_.pop_back();
        slot_of_[id] = kNoSlot;
    }

    auto begin() { return records_.begin(); }
    auto end() { return records_.end(); }
    auto begin() const { return records_.begin(); }
    auto end() const { return records_.end(); }
    uint64_t memory_bytes() const {
        return slot_of_.capacity() * sizeof(uint32_t) + records_.capacity() * sizeof(CutRecord);
    }

  private:
    static constexpr uint32_t kNoSlot = 0xffffffffu;
    std::vector<uint32_t> slot_of_;  ///< [clusters]
    std::vector<CutRecord> records_;
};

/// A heap of clusters by error, ties by id. Entries are never removed in the middle: one that no longer tells the
/// truth is left out when it comes to the top.
class CutQueue {
  public:
    /// @param is_largest_first  else the smallest error comes first
    explicit CutQueue(bool is_largest_first) : sign_(is_largest_first ? -1.0 : 1.0) {}

    struct Entry {
        double key;  ///< signed error: the least is first
        ClusterId id;
    };

    void clear() { heap_.clear(); }
    bool is_empty() const { return heap_.empty(); }
    void push(double error_px, ClusterId id);
    void pop();
    ClusterId top() const { return heap_.front().id; }
    double top_error_px() const { return sign_ * heap_.front().key; }
    uint64_t memory_bytes() const { return heap_.capacity() * sizeof(Entry); }

  private:
    double sign_;
    std::vector<Entry> heap_;
};

}  // namespace objects
