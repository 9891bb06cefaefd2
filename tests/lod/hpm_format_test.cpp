// The .hpm file: the same model comes back; whatever is cut or flipped does not.
#include "lod/progressive/hpm_format.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lod/progressive/build_hierarchy.h"
#include "tests/lod/mesh_shapes.h"

namespace {

lod::ProgressiveModel small_model() {
    lod::ProgressiveModel model;
    model.nodes = {{"case", -1, glm::dmat4(2.0)}, {"needle_100", 0, glm::dmat4(1.0)}};
    for (uint32_t node : {0u, 1u}) {
        lod::ProgressivePart part;
        part.node = node;
        part.is_glass = node == 1;
        part.hierarchy = *lod::build_hierarchy(lod_test::box(2), {}, part.report);
        model.parts.push_back(std::move(part));
    }
    return model;
}

TEST(HpmFormat, WhatIsWrittenIsRead) {
    const lod::ProgressiveModel model = small_model();
    const std::vector<unsigned char> bytes = lod::encode_hpm(model);
    const auto read = lod::decode_hpm(bytes);
    ASSERT_TRUE(read) << read.message();
    ASSERT_EQ(read->nodes.size(), 2u);
    EXPECT_EQ(read->nodes[1].name, "needle_100");
    EXPECT_EQ(read->nodes[1].parent, 0);
    EXPECT_EQ(read->nodes[0].parent_from_node, glm::dmat4(2.0));
    ASSERT_EQ(read->parts.size(), 2u);
    EXPECT_TRUE(read->parts[1].is_glass);
    EXPECT_EQ(read->parts[0].report.seam_edges, 24u);
    EXPECT_EQ(read->parts[0].hierarchy.children, model.parts[0].hierarchy.children);
    EXPECT_EQ(read->parts[0].hierarchy.kept_vertex, model.parts[0].hierarchy.kept_vertex);
    EXPECT_EQ(lod::encode_hpm(*read), bytes);
}

TEST(HpmFormat, EveryTruncationIsTold) {
    const std::vector<unsigned char> bytes = lod::encode_hpm(small_model());
    for (size_t size = 0; size < bytes.size(); ++size) {
        const auto read = lod::decode_hpm(std::span(bytes).first(size));
        ASSERT_FALSE(read) << size;
        ASSERT_NE(read.message().find("; expected"), std::string::npos) << read.message();
    }
}

TEST(HpmFormat, EveryFlippedBitIsTold) {
    std::vector<unsigned char> bytes = lod::encode_hpm(small_model());
    for (size_t bit = 0; bit < 8 * bytes.size(); bit += bit < 1024 ? 1 : 7) {
        bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1u << bit % 8));
        ASSERT_FALSE(lod::decode_hpm(bytes)) << bit;
        bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1u << bit % 8));
    }
}

/// Wrong content behind a right checksum: what a faulty writer would make.
TEST(HpmFormat, ContentIsNotTrustedForItsChecksum) {
    for (int fault = 0; fault < 6; ++fault) {
        lod::ProgressiveModel model = small_model();
        lod::VertexHierarchy& h = model.parts[0].hierarchy;
        if (fault == 0) h.kept[3] = 0xffffff;
        if (fault == 1) h.parent[2] = 1;
        if (fault == 2) h.error_m.back() = -1.0f;
        if (fault == 3) model.nodes[0].parent = 1;
        if (fault == 4) model.parts[1].node = 2;
        if (fault == 5) h.removed.pop_back();
        EXPECT_FALSE(lod::decode_hpm(lod::encode_hpm(model))) << fault;
    }
}

}  // namespace
