// BucketQueue: records ordered by a coarse logarithm of their priority; push, remove and both ends in O(1).
//
// Eight buckets an octave, taken straight from a float's bits, so an edge is exact and every machine agrees on
// the bucket. Ties inside a bucket go to the latest comer. A record has one link, so it is in one queue at most.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "lod/base/check.h"
#include "lod/base/float4.h"

namespace lod {

/// Bucket numbers: 0 not in view; 1 in view, error exactly 0; 2 … 255 rising error.
using Bucket = uint8_t;
inline constexpr uint32_t kBucketCount = 256;
inline constexpr Bucket kHiddenBucket = 0;
inline constexpr Bucket kFlatBucket = 1;
inline constexpr Bucket kFirstErrorBucket = 2;

/// Turns errors into buckets such that `reference_px` is the edge between two of them.
struct BucketScale {
    float reference_px = 1.0f;  ///< > 0

    /// Lowest edge that is told apart: 2^-12 references.
    static constexpr uint32_t kBaseBits = (127u - 12u) << 3;

    /// Four at a time, as whole numbers.
    /// @param error_px  > 0, finite
    Int4 buckets_of(Float4 error_px) const {
        const Int4 bits = std::bit_cast<Int4>(error_px / reference_px) >> 20;
        const Int4 bucket = bits - int32_t(kBaseBits) + int32_t(kFirstErrorBucket);
        const Int4 lowest = Int4{} + int32_t(kFirstErrorBucket);
        const Int4 highest = Int4{} + int32_t(kBucketCount - 1u);
        return bucket < lowest ? lowest : bucket > highest ? highest : bucket;
    }
    Bucket bucket_of(float error_px) const { return static_cast<Bucket>(buckets_of(splat(error_px))[0]); }

    /// Errors of a bucket are in [lower, upper); the topmost has no upper edge.
    float lower_px(Bucket bucket) const {
        if (bucket <= kFirstErrorBucket) return 0.0f;
        return std::bit_cast<float>((kBaseBits + bucket - kFirstErrorBucket) << 20) * reference_px;
    }
    float upper_px(Bucket bucket) const {
        if (bucket <= kFlatBucket) return 0.0f;
        if (bucket == kBucketCount - 1) return std::numeric_limits<float>::max();
        return std::bit_cast<float>((kBaseBits + bucket - kFirstErrorBucket + 1u) << 20) * reference_px;
    }

    /// lower_px and upper_px of four buckets that hold errors.
    Float4 lowers_px(Int4 bucket) const {
        const Float4 edge =
            std::bit_cast<Float4>((bucket + int32_t(kBaseBits - kFirstErrorBucket)) << 20) * reference_px;
        return bucket <= int32_t(kFirstErrorBucket) ? Float4{} : edge;
    }
    Float4 uppers_px(Int4 bucket) const {
        const Float4 edge =
            std::bit_cast<Float4>((bucket + int32_t(kBaseBits - kFirstErrorBucket + 1u)) << 20) *
            reference_px;
        return bucket == int32_t(kBucketCount - 1u) ? splat(std::numeric_limits<float>::max()) : edge;
    }
};

/// Intrusive links of one record.
struct BucketLink {
    uint32_t previous = 0xffffffffu;  ///< 0xffffffff: head of its bucket
    uint32_t next = 0xffffffffu;
};

/// Heads of the buckets; the records, with their links, live with the owner.
class BucketQueue {
  public:
    static constexpr uint32_t kNone = 0xffffffffu;

    BucketQueue() { head_.fill(kNone); }

    bool is_empty() const { return (occupied_[0] | occupied_[1] | occupied_[2] | occupied_[3]) == 0; }
    uint32_t head(Bucket bucket) const { return head_[bucket]; }

    /// @param records  [record] with a member `link`
    template <typename Record>
    void push(std::vector<Record>& records, uint32_t record, Bucket bucket) {
        const uint32_t old = head_[bucket];
        records[record].link = {kNone, old};
        if (old != kNone) records[old].link.previous = record;
        head_[bucket] = record;
        occupied_[bucket >> 6] |= uint64_t{1} << (bucket & 63);
    }

    template <typename Record>
    void remove(std::vector<Record>& records, uint32_t record, Bucket bucket) {
        const BucketLink link = records[record].link;
        if (link.next != kNone) records[link.next].link.previous = link.previous;
        if (link.previous != kNone) {
            records[link.previous].link.next = link.next;
        } else {
            head_[bucket] = link.next;
            if (link.next == kNone) occupied_[bucket >> 6] &= ~(uint64_t{1} << (bucket & 63));
        }
    }

    /// Highest and lowest bucket in use; the queue must not be empty.
    Bucket highest() const {
        for (int word = 3; word >= 0; --word) {
            const uint64_t bits = occupied_[static_cast<size_t>(word)];
            if (bits != 0) return static_cast<Bucket>(word * 64 + 63 - std::countl_zero(bits));
        }
        return 0;
    }
    Bucket lowest() const {
        for (size_t word = 0; word < 4; ++word) {
            if (occupied_[word] != 0)
                return static_cast<Bucket>(word * 64 +
                                           static_cast<size_t>(std::countr_zero(occupied_[word])));
        }
        return 0;
    }

  private:
    std::array<uint32_t, kBucketCount> head_;
    std::array<uint64_t, 4> occupied_{};
};

}  // namespace lod
