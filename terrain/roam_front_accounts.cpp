// RoamFront's accounts: its memory, and validate(), which checks the mesh, the queues and every sleeping diamond's
// promise against a fresh look.
#include <string>

#include "terrain/roam_front.h"
#include "terrain/validate.h"

namespace terrain {

std::string RoamFront::validate() const {
    std::string fault = validate_mesh(mesh_);
    if (!fault.empty()) return fault;
    uint64_t queued = 0, leaving = 0, unasked = 0;
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

uint64_t RoamFront::memory_bytes() const {
    const uint64_t record = sizeof(Diamond) + sizeof(DiamondRank) + 2 * sizeof(float);
    const uint64_t split = (mesh_.triangles() - 2) / 2;
    return mesh_.live_count() * record + split * sizeof(std::array<DiamondIndex, 4>);
}

}  // namespace terrain
