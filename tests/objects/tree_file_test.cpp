#include "objects/tree_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/objects/random_clusters.h"

namespace objects {
namespace {

TEST(TreeFile, ComesBackAsItWas) {
    const ClusterTree tree = RandomClusters(1, 300, 50.0).tree();
    const std::vector<unsigned char> bytes = encode_tree(tree);
    const auto back = decode_tree(bytes);
    ASSERT_TRUE(back) << back.message();
    EXPECT_EQ(encode_tree(*back), bytes);
    EXPECT_EQ(back->clusters.size(), tree.clusters.size());
    EXPECT_EQ(back->end_s, 50.0);
}

TEST(TreeFile, EveryTruncationIsTold) {
    const std::vector<unsigned char> bytes = encode_tree(RandomClusters(2, 20, 50.0).tree());
    for (size_t size = 0; size < bytes.size(); size += 7) {
        const auto cut = decode_tree(std::span(bytes).first(size));
        ASSERT_FALSE(cut) << size;
        EXPECT_NE(cut.message().find("expected"), std::string::npos);
    }
}

TEST(TreeFile, EveryFlippedBitIsTold) {
    std::vector<unsigned char> bytes = encode_tree(RandomClusters(3, 5, 50.0).tree());
    for (size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] ^= static_cast<unsigned char>(1u << (i % 8));
        ASSERT_FALSE(decode_tree(bytes)) << i;
        bytes[i] ^= static_cast<unsigned char>(1u << (i % 8));
    }
    EXPECT_TRUE(decode_tree(bytes));
}

/// Bytes with a true checksum whose tree makes no sense.
TEST(TreeFile, FaultsOfTheTreeAreTold) {
    const ClusterTree good = RandomClusters(4, 50, 50.0).tree();
    ASSERT_EQ(fault_of(good), "");
    const auto is_refused = [&good](const auto& spoil) {
        ClusterTree tree = good;
        spoil(tree);
        return !decode_tree(encode_tree(tree));
    };
    const auto last = good.clusters.size() - 1;
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.clusters.clear(); }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.end_s = NAN; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.indices[5] = 77; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.geometries[1].first_vertex = 0xfffffff0u; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.step_value[3] = 1.5; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.step_time_s[0] = 1.0; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.motions[0] = {4, 2}; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.keys[0].position.x = INFINITY; }));
    EXPECT_TRUE(is_refused([last](ClusterTree& t) { t.clusters[last].parent = uint32_t(last); }));
    EXPECT_TRUE(is_refused([last](ClusterTree& t) { t.clusters[last].geometry = 1u << 30; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.clusters[0].child_count = 1u << 30; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.clusters[1].radius_m = NAN; }));
    EXPECT_TRUE(is_refused([](ClusterTree& t) { t.clusters[1].visibility = 1u << 30; }));
}

}  // namespace
}  // namespace objects
