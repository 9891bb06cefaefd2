// BucketQueue: records ordered by a coarse logarithm of their priority; push, remove and both ends in O(1).
//
// Eight buckets an octave, taken straight from a float's bits, so an edge is exact and every machine agrees on
// the bucket. Ties inside a bucket go to the latest comer. A record has one link, so it is in one queue at most.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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

/// Turns errors into buckets such that `reference_px` is the edge between two of them. A bucket is the bits of the
/// error less those of the reference, without the lowest twenty: no rounding, and no division.
struct BucketScale {
    float reference_px = 1.0f;  ///< in [1e-20, 1e20]

    /// The reference's own bucket: twelve octaves above the lowest edge that is told apart.
    static constexpr int32_t kReferenceBucket = 12 * 8 + int32_t(kFirstErrorBucket);

    /// Four at a time, as whole numbers.
    /// @param error_px  > 0, finite
    Int4 buckets_of(Float4 error_px) const {
        const Int4 bucket = ((std::bit_cast<Int4>(error_px) - reference_bits()) >> 20) + kReferenceBucket;
        const Int4 lowest = Int4{} + int32_t(kFirstErrorBucket);
        const Int4 highest = Int4{} + int32_t(kBucketCount - 1u);
        return bucket < lowest ? lowest : bucket > highest ? highest : bucket;
    }
    Bucket bucket_of(float error_px) const { return static_cast<Bucket>(buckets_of(splat(error_px))[0]); }

    /// Errors of a bucket are in [lower, upper); the topmost has no upper edge.
    float lower_px(Bucket bucket) const {
        return bucket <= kFirstErrorBucket ? 0.0f : lowers_px(Int4{} + int32_t(bucket))[0];
    }
    float upper_px(Bucket bucket) const {
        return bucket <= kFlatBucket ? 0.0f : uppers_px(Int4{} + int32_t(bucket))[0];
    }

    /// lower_px and upper_px of four buckets that hold errors.
    Float4 lowers_px(Int4 bucket) const {
        return bucket <= int32_t(kFirstErrorBucket) ? Float4{} : edges_below_px(bucket);
    }
    Float4 uppers_px(Int4 bucket) const {
        return bucket == int32_t(kBucketCount - 1u) ? splat(std::numeric_limits<float>::max())
                                                    : edges_below_px(bucket + 1);
    }

  private:
    int32_t reference_bits() const { return std::bit_cast<int32_t>(reference_px); }
    Float4 edges_below_px(Int4 bucket) const {
        return std::bit_cast<Float4>(((bucket - kReferenceBucket) << 20) + reference_bits());
    }
};

/// The scale of whoever refines what is worse than a tolerance: its edge is the tolerance, rounded down, so that no
/// bucket holds errors of both sides.
/// @param tolerance_px  0: 1
inline BucketScale scale_at(double tolerance_px) {
    if (!(tolerance_px > 0.0)) return {};
    const double reference_px = std::clamp(tolerance_px, 1e-20, 1e20);
    const float nearest_px = static_cast<float>(reference_px);
    return {double(nearest_px) > reference_px ? std::nextafter(nearest_px, 0.0f) : nearest_px};
}

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
