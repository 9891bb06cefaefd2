// MeshCut under random operations: what is legal, what is drawn, whatever the order.
#include "lod/progressive/mesh_cut.h"

#include <gtest/gtest.h>

#include "lod/base/rng.h"
#include "tests/lod/plain_hierarchy.h"

namespace {

using lod::MeshCut;
using lod::NodeId;
using lod_test::PlainHistory;
using lod_test::SeenTriangle;

lod_test::PlainMesh both_kinds(uint32_t n) {
    return lod_test::joined(lod_test::bumpy_sheet(n, 5), lod_test::bumpy_ring(n, n / 2, 6));
}

/// One legal random operation, if the random node has one. @param appetite  share of splits wanted
bool random_operation(MeshCut& cut, lod::Rng& rng, double appetite) {
    const lod::ProgressiveMesh& mesh = cut.mesh();
    const NodeId node = mesh.leaf_count() + static_cast<NodeId>(rng.below(mesh.hierarchy.collapse_count()));
    if (cut.is_active(node)) {
        if (rng.unit() > appetite || cut.split_blocker(node) != lod::kNoNode) return false;
        cut.vsplit(node);
        return true;
    }
    if (rng.unit() < appetite || !cut.are_children_active(node) || cut.collapse_blocker(node) != lod::kNoNode)
        return false;
    cut.ecol(node);
    return true;
}

/// Splits for a while, then collapses for a while, never the same share.
double appetite_at(uint64_t operation, uint64_t period) {
    return (operation / period) % 2 == 0 ? 0.55 + 0.4 * double(operation % 7) / 7.0 : 0.3;
}

SeenTriangle seen(const MeshCut& cut, uint32_t t) {
    return {t, cut.corners(t)[0], cut.corners(t)[1], cut.corners(t)[2]};
}

/// All drawn triangles that have one of the nodes for a corner, by looking at all of them.
std::vector<std::set<SeenTriangle>> stars_of(const MeshCut& cut) {
    std::vector<std::set<SeenTriangle>> stars(cut.mesh().hierarchy.node_count());
    for (uint32_t t = 0; t < cut.mesh().triangle_count(); ++t) {
        if (!cut.is_drawn(t)) continue;
        for (NodeId corner : cut.corners(t))
            stars[corner].insert(seen(cut, t));
    }
    return stars;
}

TEST(MeshCut, AMillionRandomOperationsDrawOnlyTrianglesOfTheBuild) {
    const PlainHistory history = lod_test::make_plain_history(both_kinds(36));
    const lod::ProgressiveMesh mesh = lod::make_progressive_mesh(history.hierarchy);
    MeshCut cut(mesh);
    lod::Rng rng(11);
    uint32_t least = cut.triangle_count(), most = 0;
    for (uint64_t done = 0; done < 1'000'000;) {
        if (!random_operation(cut, rng, appetite_at(done, 3000))) continue;
        least = std::min(least, cut.triangle_count());
        most = std::max(most, cut.triangle_count());
        if (++done % 100 != 0) continue;
        // What was touched is all that can have gone wrong since the last look.
        for (uint32_t t : cut.touched()) {
            const bool is_known = !cut.is_drawn(t) || history.seen.contains(seen(cut, t));
            ASSERT_TRUE(is_known) << "triangle " << t << " after " << done << " operations";
        }
        cut.forget_touched();
        const std::string fault = done % 20'000 == 0 ? cut.validate() : "";
        ASSERT_EQ(fault, "") << done;
    }
    RecordProperty("least", static_cast<int>(least));
    RecordProperty("most", static_cast<int>(most));
    EXPECT_LT(least, most / 3);
}

/// M and m of every active node, from the drawn triangles.
struct Ring {
    NodeId largest = 0, oldest_parent = lod::kNoNode;
};
std::vector<Ring> rings_of(const MeshCut& cut) {
    std::vector<Ring> rings(cut.mesh().hierarchy.node_count());
    for (uint32_t t = 0; t < cut.mesh().triangle_count(); ++t) {
        if (!cut.is_drawn(t)) continue;
        for (NodeId node : cut.corners(t)) {
            for (NodeId other : cut.corners(t)) {
                if (other == node) continue;
                rings[node].largest = std::max(rings[node].largest, other);
                rings[node].oldest_parent =
                    std::min(rings[node].oldest_parent, cut.mesh().hierarchy.parent[other]);
            }
        }
    }
    return rings;
}

/// Explicit dependency lists: an operation is allowed when the triangles around it are those the build saw.
TEST(MeshCut, IdentifiersAllowExactlyWhatExplicitListsAllow) {
    for (const uint32_t n : {12u, 57u}) {  // the larger: 4873 vertices
        const PlainHistory history = lod_test::make_plain_history(both_kinds(n));
        const lod::ProgressiveMesh mesh = lod::make_progressive_mesh(history.hierarchy);
        ASSERT_LE(mesh.leaf_count(), 5000u);
        MeshCut cut(mesh);
        lod::Rng rng(3);
        uint64_t asked = 0, allowed = 0;
        for (int look = 0; look < 40; ++look) {
            for (int i = 0; i < 40'000; ++i)
                random_operation(cut, rng, appetite_at(static_cast<uint64_t>(look), 3));
            const std::vector<std::set<SeenTriangle>> stars = stars_of(cut);
            const std::vector<Ring> ring = rings_of(cut);
            for (uint32_t k = 0; k < mesh.hierarchy.collapse_count(); ++k) {
                const NodeId node = mesh.leaf_count() + k;
                bool by_lists = false, by_identifiers = false;
                if (cut.is_active(node)) {
                    by_lists = stars[node] == history.after[k];
                    by_identifiers = node > ring[node].largest;
                    ASSERT_EQ(cut.split_blocker(node) == lod::kNoNode, by_lists) << "split " << node;
                } else if (cut.are_children_active(node)) {
                    const auto [a, b] = mesh.hierarchy.children[k];
                    std::set<SeenTriangle> star = stars[a];
                    star.insert(stars[b].begin(), stars[b].end());
                    by_lists = star == history.before[k];
                    by_identifiers = node <= ring[a].oldest_parent && node <= ring[b].oldest_parent;
                    ASSERT_EQ(cut.collapse_blocker(node) == lod::kNoNode, by_lists) << "collapse " << node;
                } else {
                    continue;
                }
                ++asked;
                allowed += by_lists ? 1 : 0;
                ASSERT_EQ(by_identifiers, by_lists) << "node " << node << ", look " << look;
            }
        }
        EXPECT_GT(allowed, asked / 10);
        EXPECT_LT(allowed, asked);
    }
}

TEST(MeshCut, GoesFromCoarsestToFullAndBack) {
    const lod::ProgressiveMesh mesh =
        lod::make_progressive_mesh(lod_test::make_plain_history(both_kinds(24)).hierarchy);
    MeshCut cut(mesh);
    const uint64_t coarsest = cut.hash();
    const uint32_t fewest = cut.triangle_count();
    for (NodeId node = mesh.hierarchy.node_count(); node-- > mesh.leaf_count();) {
        ASSERT_EQ(cut.split_blocker(node), lod::kNoNode);
        cut.vsplit(node);
    }
    EXPECT_EQ(cut.triangle_count(), mesh.triangle_count());
    for (uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        ASSERT_TRUE(cut.is_drawn(t));
        ASSERT_TRUE(
            std::equal(cut.corners(t).begin(), cut.corners(t).end(), mesh.hierarchy.triangles[t].begin()));
    }
    EXPECT_EQ(cut.validate(), "");
    EXPECT_NE(cut.hash(), coarsest);
    for (NodeId node = mesh.leaf_count(); node < mesh.hierarchy.node_count(); ++node) {
        ASSERT_EQ(cut.collapse_blocker(node), lod::kNoNode);
        cut.ecol(node);
    }
    EXPECT_EQ(cut.triangle_count(), fewest);
    EXPECT_EQ(cut.hash(), coarsest);
    EXPECT_EQ(cut.validate(), "");
}

}  // namespace
