// hash_bytes: what a checksum has to notice.
#include "lod/base/hash.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "lod/base/rng.h"

namespace {

std::vector<unsigned char> random_bytes(size_t count) {
    lod::Rng rng(count);
    std::vector<unsigned char> bytes(count);
    for (unsigned char& byte : bytes)
        byte = static_cast<unsigned char>(rng.below(256));
    return bytes;
}

TEST(HashBytes, NoticesEveryBitOfEveryLength) {
    for (size_t count : {1u, 7u, 8u, 31u, 32u, 33u, 64u, 100u, 1000u}) {
        std::vector<unsigned char> bytes = random_bytes(count);
        const uint64_t whole = lod::hash_bytes(bytes);
        for (size_t bit = 0; bit < 8 * count; ++bit) {
            bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
            ASSERT_NE(lod::hash_bytes(bytes), whole) << count << " bytes, bit " << bit;
            bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
        }
    }
}

TEST(HashBytes, NoticesWhatIsCutOffAndWhatChangesPlaces) {
    const std::vector<unsigned char> zeros(200, 0);
    std::set<uint64_t> hashes;
    for (size_t count = 0; count <= zeros.size(); ++count)
        hashes.insert(lod::hash_bytes(std::span(zeros).first(count)));
    EXPECT_EQ(hashes.size(), zeros.size() + 1);

    std::vector<unsigned char> bytes = random_bytes(256);
    const uint64_t whole = lod::hash_bytes(bytes);
    for (size_t i = 0; i < 256; i += 8) {
        for (size_t j = i + 8; j < 256; j += 8) {
            std::swap_ranges(&bytes[i], &bytes[i] + 8, &bytes[j]);
            ASSERT_NE(lod::hash_bytes(bytes), whole) << i << ' ' << j;
            std::swap_ranges(&bytes[i], &bytes[i] + 8, &bytes[j]);
        }
    }
}

TEST(HashBytes, GoesOnFromAnotherHash) {
    const std::vector<unsigned char> bytes = random_bytes(50);
    EXPECT_NE(lod::hash_bytes(bytes, 1), lod::hash_bytes(bytes, 2));
    EXPECT_EQ(lod::hash_bytes(bytes, 3), lod::hash_bytes(bytes, 3));
}

}  // namespace
