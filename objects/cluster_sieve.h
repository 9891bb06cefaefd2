// ClusterSieve: takes the triangles that no pixel shows out of what clusters draw (lod/triangle_sieve.h), and puts what is left of
// one instance together in one command.
//
//     picture  | strip | strip | strip | strip |    judged by themselves, by whichever thread is free
//
// All are asked as long as enough of them are found hidden. Otherwise one strip is asked every few frames, another one each
// time, whether asking would pay again: no frame is late for a question.
#pragma once

#include <array>
#include <vector>

#include "lod/triangle_sieve.h"
#include "objects/scene_view.h"

namespace objects {

class ClusterSieve {
  public:
    static constexpr size_t kStrips = 4;  ///< whatever the number of threads: so is what is kept
    /// Indices at most that are kept; what finds no room is drawn as it is.
    static constexpr uint32_t kRoom = 1'500'000;

    /// A view of a tree whose geometry stands in a region of the pool.
    struct Scene {
        const ClusterTree& tree;
        const lod::PoolRegion& region;
        const lod::View& view;
        const SceneView& sight;  ///< of the same view
        double time_s = 0.0;
    };

    void begin(const lod::View& view);

    /// Takes note of the opaque items from `first_item` on, all those of one cluster. Clusters come from near to far.
    void add(const Scene& scene, const Cluster& cluster, size_t first_item, const lod::DrawList& out);

    /// Replaces the items of neighbours with one instance by one with what may show of them, or by none; glass stays. The
    /// indices stand behind the tree's own in the region: a write says so. Learns from the frame.
    /// @returns triangles left out
    uint64_t finish(const Scene& scene, unsigned threads, lod::DrawList& out);

    uint64_t memory_bytes() const;

  private:
    /// The opaque items of a cluster.
    struct Piece {
        uint32_t geometry = 0;
        bool is_asked = false;
        size_t first_item = 0, end_item = 0;
        size_t first_triangle = 0, end_triangle = 0;  ///< of shows_
        lod::Columns columns{};                       ///< that hold its box
        std::array<glm::dvec3, 8> box_eye{};
    };
    void judge(const Scene& scene, const lod::DrawList& list, size_t strip);
    uint32_t keep(const Scene& scene, const Piece& piece);
    void replace_items(const Scene& scene, lod::DrawList& out);
    void learn();

    std::array<lod::TriangleSieve, kStrips> sieves_;
    std::array<lod::Columns, kStrips> strips_;
    std::vector<Piece> pieces_;
    std::vector<uint8_t> shows_;  ///< [triangles of all pieces]
    std::vector<uint32_t> kept_;
    std::vector<lod::DrawItem> items_;   ///< as they came
    uint64_t left_out_ = 0, asked_ = 0;  ///< triangles
    bool pays_ = true;
    size_t frames_idle_ = 0;  ///< since it last paid
};

}  // namespace objects
