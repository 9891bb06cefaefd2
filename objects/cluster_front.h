// ClusterFront: the cut through a cluster tree that is drawn now, behind lod::Front; it follows the eye and the
// schedule.
//
//     root            refined     its children stand for it
//      +- cluster     active      stands for everything below: drawn when half of it is there and in view
//      +- cluster     refined
//          +- leaf    active
//
// A cluster without geometry that is in view is refined at once and stays so, whatever the budget: nothing could stand
// for it.
// Refining replaces an active cluster by its children; coarsening takes a refined one back with everything below it.
// Any refined cluster may be taken back, not only one above the cut's end: what a whole branch costs is its own error.
//
// Time: a cluster's presence is a step function, so it is looked up again only when the schedule leaves the step it is
// in, forwards, backwards or by a jump. What the eye sees is evaluated anew for the cut alone, some thousands of
// records whatever the scene holds; when neither eye nor anything else has moved, not at all.
//
// What is drawn comes near to far. What solids hide (cluster_occlusion.h) is neither refined nor drawn. Solids of what was drawn in the frame before hide it;
// where one of these is refined away in this frame, all that was hidden is looked at again once nothing else is left to
// do, and before anything is drawn. Of what is drawn, triangles that no pixel shows can be left out (cluster_sieve.h).
//
// Source: Semenov, Shutkin, Zolotov et al. (2020), section 2 and appendix 1. Differs from it in: a state between
// frames, a budget, moving clusters.
#pragma once

#include <string>
#include <vector>

#include "lod/front.h"
#include "objects/cluster_cut.h"
#include "objects/cluster_occlusion.h"
#include "objects/cluster_sieve.h"
#include "objects/scene_view.h"

namespace objects {

/// What is left out because it is hidden; the picture is always the same.
enum class Hiding : uint8_t {
    kNothing,
    kClusters,   ///< clusters behind solids: not refined either
    kTriangles,  ///< and of the rest all triangles that no pixel shows; pays before a software rasteriser
};

class ClusterFront final : public lod::Front {
  public:
    /// @param tree   kept; at least a root
    /// @param place  a rotation, orthonormal, and a finite origin
    ClusterFront(ClusterTree tree, const ScenePlace& place);

    /// kClusters unless told otherwise. Before place(): triangles that may show are written to the pool, which takes room.
    /// @param threads  look for them; what is found is the same
    void set_hiding(Hiding hiding, unsigned threads = 1) { hiding_ = hiding, threads_ = threads; }

    /// 0.98 unless told otherwise: a whole cluster is exchanged for another by one step, so hysteresis is worth little.
    /// @param ratio  in (0, 1]; with 1 the cut follows from view and time alone
    void set_coarsen_ratio(double ratio) { coarsen_ratio_ = ratio; }
    double coarsen_ratio() const override { return coarsen_ratio_; }

    /// Moves the whole scene; the next frame sees everything anew. @param place  as for the constructor
    void stand_at(const ScenePlace& place);

    /// @param time_s  of the schedule; any, clamped to [0, T]; NaN counts as 0
    void begin_frame(std::span<const lod::View> views, double time_s) override;
    double refine_error_px() override;
    double coarsen_error_px() override;
    lod::Step refine() override;
    lod::Step coarsen(double limit_px) override;
    bool settle() override;
    uint64_t triangles() const override { return triangles_; }
    double error_px() override;
    double jump_px() const override { return jump_px_; }
    lod::OperationCounts operations() const override { return operations_; }
    uint64_t hash() const override { return hash_; }
    lod::PoolRegion pool_need() const override;
    void place(const lod::PoolRegion& region) override;
    void emit(const lod::View& view, lod::DrawList& out) override;
    uint64_t emitted_triangles() const override { return emitted_; }
    std::string validate() const override;

    const ClusterTree& tree() const { return tree_; }
    /// The clusters that would be drawn now, in view of some eye, not hidden and half there at least, ascending. What
    /// DISPLAY makes when nothing hides anything. @param drawn  cleared first
    void drawn(std::vector<ClusterId>& drawn) const;
    /// Presences looked up since construction.
    uint64_t presence_lookups() const { return presence_lookups_; }
    /// Sights evaluated since construction.
    uint64_t evaluations() const { return evaluations_; }
    /// Bytes beside the tree, in use.
    uint64_t memory_bytes() const;

  private:
    void look_up_presence(CutRecord& record);
    void evaluate(CutRecord& record);
    void count_triangles(const CutRecord& record, int64_t sign);
    void add(ClusterId id);
    void remove(ClusterId id);
    void offer(const CutRecord& record);
    bool needs_children(const CutRecord& record) const;
    uint32_t open(ClusterId id);
    uint32_t take_back(ClusterId id);
    void cover();
    void emit_writes(lod::DrawList& out);
    void line_up(const SceneView& sight);

    ClusterTree tree_;
    ScenePlace place_;
    Hiding hiding_ = Hiding::kClusters;
    unsigned threads_ = 1;
    double coarsen_ratio_ = 0.98;
    ClusterCut cut_;
    ClusterOcclusion occlusion_;
    bool is_uncovered_ = false;  ///< some occluder is no longer drawn
    uint64_t changes_ = 0;       ///< clusters opened and taken back since all of the cut was looked at
    CutQueue worst_{true}, cheapest_{false};

    std::vector<lod::View> views_;  ///< of this frame
    std::vector<SceneView> sights_;
    double time_s_ = -1.0;
    uint64_t triangles_ = 0, emitted_ = 0, hash_ = 0;
    double jump_px_ = 0.0;
    lod::OperationCounts operations_;
    uint64_t presence_lookups_ = 0, evaluations_ = 0;
    std::vector<ClusterId> stack_, to_open_;

    struct Drawn {
        float depth_m = 0.0f;  ///< of its sphere's centre
        ClusterId id = kNoCluster;
    };
    std::vector<Drawn> line_;  ///< what emit() draws, near to far
    ClusterSieve sieve_;

    lod::PoolRegion region_;
    bool is_written_ = false;
};

}  // namespace objects
