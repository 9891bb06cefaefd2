// IndexRuns: the index list of a diamond mesh in runs that stay as they are until something below them changes.
//
// A run is the leaves below one triangle of the bintree. Above the runs stands a small binary tree, a coarse copy of
// the bintree: it finds the runs that a split or a merge concerns by where that was, and it is what a view is
// culled by. A run that grows too long is taken apart, two short sisters become one.
//
//     list   [ run | room | run | room | run … ]     in Sierpinski order; room is filled with triangles without area
//
// So any stretch of the list can be drawn as it is. What hangs below a node of the tree lies together, and a run that
// outgrows its room takes from the smallest node around it that has some.
// Source: Bender, Demaine and Farach-Colton, Cache-oblivious B-trees (2000), packed-memory arrays.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/bintree_triangle.h"
#include "terrain/leaf_writer.h"

namespace terrain {

/// A stretch of the list.
struct IndexRange {
    uint32_t first = 0, count = 0;
    uint32_t end() const { return first + count; }
};

/// A triangle of the tree: either two others, or a run.
struct RunNode {
    static constexpr uint32_t kPlaced = 0xffffffffu;

    BintreeTriangle triangle;
    std::array<GridPoint, 3> points;          ///< apex, left, right
    uint32_t children = 0;                    ///< the first of two nodes side by side; 0: a run
    uint32_t first = 0, count = 0, room = 0;  ///< place in the list; `room` counts what is in use as well
    uint32_t fresh = kPlaced;  ///< a run's contents that are not in the list yet: where they are
    bool is_stale = false;     ///< something below has changed
    bool is_hit = false;       ///< its own diamond has been split or merged
    bool lacks_room = false;
    bool has_news = true;  ///< contents to be put into the list, here or below

    bool is_run() const { return children == 0; }
};

class IndexRuns {
  public:
    /// Longest run, in indices; two sisters that have together less than kFew become one.
    static constexpr uint32_t kMost = 3 * 40, kFew = 3 * 26;

    /// Forgets all runs and takes a list of another length. What is needed for so many triangles: room_for().
    void reset(uint32_t capacity);
    static uint32_t room_for(uint64_t triangles);
    /// Runs there are likely to be at the most.
    size_t most_runs() const { return list_.size() / kFew + 64; }

    /// The diamond with this centre has been split or merged.
    void mark(GridPoint centre);
    /// Nothing is as it was.
    void mark_all() { is_all_marked_ = true; }

    /// Makes the runs what the mesh is now.
    /// @param writer  writes into fresh()
    /// CHECKs that the list is long enough. Cost: as what was marked; allocates nothing once warm.
    void update(const DiamondMesh& mesh, const LeafWriter& writer);

    /// Ranges of the list that the last update has written.
    std::span<const IndexRange> changed() const { return changed_; }
    std::span<const uint32_t> list() const { return list_; }
    /// The two triangles of the domain are the first two.
    std::span<const RunNode> nodes() const { return nodes_; }
    std::vector<uint32_t>& fresh() { return fresh_; }

  private:
    struct Built {
        uint32_t fresh = 0, count = 0;  ///< contents, or how many there are in …
        uint32_t children = 0;          ///< … two nodes
    };
    struct Work {
        const DiamondMesh& mesh;
        const LeafWriter& writer;
    };

    void mark_below(uint32_t id, GridPoint centre);
    Built build(const Work& work, const BintreeTriangle& triangle);
    RunNode node_of(const Work& work, const BintreeTriangle& triangle, const Built& built) const;
    void rebuild(const Work& work, uint32_t id);
    void rebuild_all(const Work& work);
    void refresh(const Work& work, uint32_t id);
    void retire(const Work& work, const RunNode& node);
    uint32_t add_pair();

    void make_room(uint32_t id);
    void make_room_for_all();
    void lift(uint32_t id);
    void lay(uint32_t id, uint32_t first, uint32_t room);
    void put_below(uint32_t id);
    void put(RunNode& node);

    std::vector<RunNode> nodes_;
    std::vector<uint32_t> free_pairs_;
    std::vector<uint32_t> list_, fresh_;
    std::vector<IndexRange> changed_;
    size_t mark_count_ = 0;  ///< since the last update
    bool is_all_marked_ = true;
};

}  // namespace terrain
