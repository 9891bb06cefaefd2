// RoamFront's accounts: what it draws and needs, its memory, and validate(), which checks the mesh, the queues and every sleeping diamond's
// promise against a fresh look.
#include <algorithm>
#include <string>

#include "terrain/roam_front.h"
#include "terrain/validate.h"

namespace terrain {

std::string RoamFront::validate() const {
    std::string fault = validate_mesh(mesh_);
    if (!fault.empty()) return fault;
    uint64_t queued = 0, leaving = 0, idle = 0, unasked = 0;
    for (DiamondIndex i = kRoot; i < mesh_.record_count(); ++i) {
        const Diamond& d = mesh_[i];
        const Queue expected = !d.is_used()        ? Queue::kNone
                               : !d.is_split       ? Queue::kSplit
                               : d.split_kids == 0 ? Queue::kMerge
                                                   : Queue::kNone;
        const bool is_unasked = expected == Queue::kSplit && queue_of(i) == Queue::kUnasked;
        const bool waits = expected == Queue::kSplit && queue_of(i) == Queue::kWait;
        const bool leaves = expected == Queue::kMerge && queue_of(i) == Queue::kLeave;
        if (leaves) leaving += triangles_of(i);
        if (d.is_used() && d.is_split && is_idle(i)) idle += parents_of(i);
        if (queue_of(i) != expected && !waits && !leaves && !is_unasked)
            return "diamond " + std::to_string(i) + " is in the wrong queue";
        unasked += is_unasked ? 1 : 0;
        queued += expected != Queue::kNone && !is_unasked ? 1 : 0;
        const bool is_ranked = d.is_used() && !is_unasked && (is_queued(i) || wake_m_[i] != kNever);
        if (!is_ranked || odometer_.eyes().empty()) continue;
        if (evaluate_some({&i, 1}, 1.0f).error_px[0] > scale_.upper_px(bucket_of(i))) {
            return "diamond " + std::to_string(i) + " is worse than its bucket says";
        }
    }
    if (unasked != unasked_.size()) return "miscounts what is unasked";
    if (leaving != leaving_triangles_) return "miscounts what leaves";
    if (idle != idle_triangles_) return "miscounts splits that draw nothing new";
    uint64_t linked = 0;
    for (const BucketQueue& queue : queues_) {
        for (uint32_t b = 0; b < kBucketCount; ++b) {
            for (uint32_t i = queue.head(static_cast<Bucket>(b)); i != BucketQueue::kNone;
                 i = ranks_[i].link.next) {
                if (bucket_of(i) != b) return "diamond " + std::to_string(i) + " hangs in the wrong bucket";
                if (++linked > queued) return "a queue has a loop or a stray record";
            }
        }
    }
    return linked == queued ? "" : "a queue has lost a record";
}

/// A diamond is being split, or merged.
void RoamFront::note_change(DiamondIndex index, bool is_split) {
    tessellator_.change(mesh_[index].centre());
    if (!is_idle(index)) return;
    idle_triangles_ += is_split ? parents_of(index) : -uint64_t{parents_of(index)};
}

uint64_t RoamFront::most_triangles() const {
    return std::max(triangles() + leaving_triangles(), options_.reserve_triangles);
}

uint32_t RoamFront::most_records() const {
    const uint64_t reserved = (options_.reserve_triangles >> (2 * options_.batch)) * 5 / 4 + 64;
    return std::max(mesh_.record_count(), static_cast<uint32_t>(reserved));
}

lod::PoolRegion RoamFront::pool_need() const {
    return tessellator_.need(most_triangles(), most_records());
}

void RoamFront::place(const lod::PoolRegion& region) {
    tessellator_.place(region, most_triangles(), most_records());
}

uint64_t RoamFront::memory_bytes() const {
    const uint64_t record = sizeof(Diamond) + sizeof(DiamondRank) + 2 * sizeof(float);
    const uint64_t split = (mesh_.triangles() - 2) / 2;
    return mesh_.live_count() * record + split * sizeof(std::array<DiamondIndex, 4>);
}

}  // namespace terrain
