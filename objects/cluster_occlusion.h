// ClusterOcclusion: which clusters are hidden from all eyes by solids of others that are drawn.
//
// The largest solids in each picture are its occluders. What is hidden changes no pixel as long as these are drawn: their
// records are marked, so that whoever takes one away knows.
#pragma once

#include <span>
#include <vector>

#include "lod/occlusion_map.h"
#include "objects/cluster_cut.h"
#include "objects/scene_view.h"

namespace objects {

class ClusterOcclusion {
  public:
    /// Fills a map for each eye with solids of what is drawn now.
    /// @param records  is_occluder is set or cleared in all of them  @param time_s  as for pose_of
    /// Cost: that of a selection among the records, and of at most 128 geometries an eye.
    void begin(const ClusterTree& tree, std::span<const lod::View> views, std::span<const SceneView> sights,
               std::span<CutRecord> records, double time_s);
    /// From now on nothing is hidden.
    void clear();

    /// Whether an eye sees nothing of a box, as all of it lies behind solids in that picture.
    bool hides(size_t eye, const lod::EyeBox& box) const { return !is_empty_ && maps_[eye].hides(box); }

    /// Says how many of the clusters in view were hidden, so that the next map has more occluders or fewer, or none for some
    /// frames: they pay in streets, hardly from above.
    void learn(uint64_t hidden, uint64_t seen);

    /// Whether some of the occluders move: then what they hide changes with the time.
    bool moves() const { return moves_; }

  private:
    struct Occluder {
        CutRecord* record = nullptr;
        double size_px = 0.0;
        double depth_m = 0.0;
    };
    void select(const ClusterTree& tree, const SceneView& sight, std::span<CutRecord> records, double time_s);

    std::vector<lod::OcclusionMap> maps_;  ///< one an eye
    bool is_empty_ = true, moves_ = false;
    size_t most_occluders_ = 64;
    uint32_t rest_ = 0;             ///< frames in which nothing is asked
    std::vector<Occluder> chosen_;  ///< scratch
};

}  // namespace objects
