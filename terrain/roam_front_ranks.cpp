// RoamFront's ranks: what records are worth in pixels, when they are asked, and in which queue and bucket they are.
#include <algorithm>

#include "terrain/roam_front.h"

namespace terrain {

/// @param some   one to four
/// @param reach  how many radii around each count as its own
FourEvaluations RoamFront::evaluate_some(std::span<const DiamondIndex> some, float reach) const {
    std::array<BoundFacts, 4> facts;
    lod::Int4 watches_fall{};
    // Always four: a lane too many costs less than a branch that nobody can foresee.
    for (size_t lane = 0; lane < 4; ++lane) {
        const DiamondIndex index = some[lane < some.size() ? lane : 0];
        facts[lane] = {&mesh_[index], &ranks_[index].source};
        watches_fall[lane] = mesh_[index].is_split ? -1 : 0;
    }
    FourBounds bounds = bound_of_(facts);
    bounds.radius_m *= reach;
    return evaluate(bounds, odometer_.eyes(), scale_, watches_fall);
}

/// Evaluates at most four records and sets when they wake next.
void RoamFront::rank(std::span<const DiamondIndex> some) {
    evaluations_ += some.size();
    const FourEvaluations now = evaluate_some(some, 1.0f);
    lod::Float4 walk_m, turn_rad;
    odometer_.alarms(now, walk_m, turn_rad);
    for (size_t lane = 0; lane < some.size(); ++lane) {
        mesh_.set_rank(some[lane], static_cast<Bucket>(now.bucket[lane]), stamp_ & kStampMask);
        wake_m_[some[lane]] = walk_m[lane];
        wake_rad_[some[lane]] = turn_rad[lane];
    }
}

void RoamFront::enqueue(DiamondIndex index, Queue queue) {
    DCHECK(!is_queued(index) || queue_of(index) == Queue::kUnasked);
    mesh_.set_queue(index, static_cast<uint8_t>(queue));
    queue_at(queue).push(ranks_, index, bucket_of(index));
}

void RoamFront::dequeue(DiamondIndex index) {
    if (!is_queued(index)) return;
    unlink(index);
    wake_m_[index] = wake_rad_[index] = kNever;
}

/// Out of its queue, but still awake at its time.
void RoamFront::unlink(DiamondIndex index) {
    queue_at(queue_of(index)).remove(ranks_, index, bucket_of(index));
    mesh_.set_queue(index, static_cast<uint8_t>(Queue::kNone));
}

/// Evaluates at most four queued records anew and moves them to their buckets.
void RoamFront::refresh(std::span<const DiamondIndex> some) {
    std::array<Bucket, 4> before{};
    for (size_t i = 0; i < some.size(); ++i)
        before[i] = bucket_of(some[i]);
    rank(some);
    for (size_t i = 0; i < some.size(); ++i) {
        if (bucket_of(some[i]) == before[i]) continue;
        if (queue_of(some[i]) == Queue::kLeave && bucket_of(some[i]) > before[i]) {
            queue_at(Queue::kLeave).remove(ranks_, some[i], before[i]);
            mesh_.set_queue(some[i], static_cast<uint8_t>(Queue::kNone));
            stay(some[i]);
            enqueue(some[i], Queue::kMerge);
            continue;
        }
        BucketQueue& queue = queue_at(queue_of(some[i]));
        queue.remove(ranks_, some[i], before[i]);
        queue.push(ranks_, some[i], bucket_of(some[i]));
    }
}

/// New candidates, of one level: the loads of their facts begin; what they are worth is asked later, four at a time.
void RoamFront::announce(std::span<const DiamondIndex> candidates) {
    if (candidates.empty()) return;
    const int level = mesh_[candidates[0]].level;
    for (DiamondIndex index : candidates) {
        const DiamondSource& facts = table_.at(mesh_[index].centre(), level);
        __builtin_prefetch(&facts);
        mesh_.set_queue(index, static_cast<uint8_t>(Queue::kUnasked));
        unasked_.push({index, &facts});
    }
}

/// Asks the eldest until at most `most` are left.
void RoamFront::ask(uint32_t most) {
    while (unasked_.size() > most) {
        std::array<DiamondIndex, 4> some{};
        const uint32_t count = std::min(unasked_.size(), 4u);
        for (uint32_t i = 0; i < count; ++i) {
            const Unasked next = unasked_.pop();
            some[i] = next.index;
            ranks_[next.index].source = *next.facts;
        }
        rank({some.data(), count});
        for (uint32_t i = 0; i < count; ++i)
            enqueue(some[i], Queue::kSplit);
    }
}

/// A record that was in no queue for a while enters one. What was said of it holds until its alarm.
void RoamFront::offer(DiamondIndex index, Queue queue) {
    if (wake_m_[index] == kNever) rank({&index, 1});
    enqueue(index, queue);
}

/// After the odometers began again. What sleeps keeps the rest of its guard; under other optics it wakes.
void RoamFront::rewind_alarms(EyeOdometer::Step step) {
    const bool holds = step == EyeOdometer::Step::kRewound;
    for (size_t i = 0; i < mesh_.record_count(); ++i) {
        if (wake_m_[i] == kNever) continue;
        wake_m_[i] =
            holds ? static_cast<float>(double(wake_m_[i]) - odometer_.walked_before_m() - 1e-3) : -1.0f;
        wake_rad_[i] =
            holds ? static_cast<float>(double(wake_rad_[i]) - odometer_.turned_before_rad() - 1e-7) : -1.0f;
    }
}

/// Every queued record whose guard this frame's motion may have used up. Nothing is said any more of those in no
/// queue.
void RoamFront::collect_due() {
    constexpr size_t kBlock = 64;
    due_.clear();
    const float walked = odometer_.walked_m(), turned = odometer_.turned_rad();
    const size_t count = mesh_.record_count();
    for (size_t begin = 0; begin < count; begin += kBlock) {
        const size_t end = std::min(count, begin + kBlock);
        int any = 0;
        for (size_t i = begin; i < end; ++i)
            any |= static_cast<int>(wake_m_[i] < walked) | static_cast<int>(wake_rad_[i] < turned);
        if (any == 0) continue;
        for (size_t i = begin; i < end; ++i) {
            if (wake_m_[i] >= walked && wake_rad_[i] >= turned) continue;
            const auto index = static_cast<DiamondIndex>(i);
            if (is_queued(index)) {
                due_.push_back(index);
            } else {
                wake_m_[i] = wake_rad_[i] = kNever;
            }
        }
    }
}

}  // namespace terrain
