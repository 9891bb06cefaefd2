// MeshFront: instruments and other meshes behind lod::Front: view-dependent progressive meshes of many bodies.
//
//     ProgressiveMesh  a vertex hierarchy, shared by all bodies that show it    (mesh_tables.h)
//     MeshBody         one body's cut, ranks and glides, in its own frame       (mesh_body.h)
//     MeshSheet        its triangles in the geometry pool                       (mesh_sheet.h)
//
// A body is a frame that may move every frame: a needle on its dial, a dial in the cockpit, a mast in the landscape.
// Two queues of bodies, by the worst node and the cheapest collapse of each, make of many bodies one front: an
// operation costs the same for a hundred of them.
//
// Sources: Kalachev, Reshetnikova (see docs), steps 5 to 8; El-Sana, Varshney (1999); Hoppe (1997).
#pragma once

#include <vector>

#include "lod/body_pose.h"
#include "lod/progressive/mesh_body.h"
#include "lod/progressive/mesh_sheet.h"

namespace lod {

/// One body: which mesh it shows and where it stands at the beginning.
struct MeshPlacement {
    uint32_t mesh = 0;
    BodyPose pose;
};

class MeshFront final : public Front {
  public:
    /// CHECKs that every placement names a mesh.
    MeshFront(Module module, std::vector<ProgressiveMesh> meshes, std::span<const MeshPlacement> placements,
              const MeshOptions& options);

    /// Moves a body; takes effect with the next begin_frame.
    void set_pose(uint32_t body, const BodyPose& pose);

    void begin_frame(std::span<const View> views, double time_s) override;
    double refine_error_px() override;
    double coarsen_error_px() override;
    Step refine() override;
    Step coarsen(double limit_px) override;
    /// What sleeping bodies hold is not drawn and not counted (mesh_body.h).
    uint64_t triangles() const override { return triangles_; }
    uint64_t leaving_triangles() const override;
    double error_px() override;
    double jump_px() const override;
    OperationCounts operations() const override;
    uint64_t hash() const override;
    PoolRegion pool_need() const override;
    void place(const PoolRegion& region) override;
    void emit(const View& view, DrawList& out) override;
    uint64_t emitted_triangles() const override { return emitted_; }
    std::string validate() const override;

    uint32_t body_count() const { return static_cast<uint32_t>(bodies_.size()); }
    const MeshBody& body(uint32_t index) const { return bodies_[index].body; }
    /// Draw items of one view, at most.
    uint32_t item_count() const { return body_count(); }
    /// Evaluations since construction.
    uint64_t evaluations() const;

  private:
    struct Entry {
        Entry(const ProgressiveMesh& mesh, const MeshPlacement& placement, const MeshOptions& options)
            : pose(placement.pose), body(mesh, options), sheet(mesh) {}
        BodyPose pose;
        MeshBody body;
        MeshSheet sheet;
    };
    /// A body's place in one of the two queues of bodies.
    struct Place {
        BucketLink link;
        Bucket bucket = kHiddenBucket;
        bool is_queued = false;
        bool is_asked = true;
    };
    struct BodyQueue {
        BucketQueue queue;
        std::vector<Place> places;
        std::vector<uint32_t>
            unasked;  ///< bodies that changed since they were last asked; a test of emptiness a query
        void forget(uint32_t body);
        void move(uint32_t body, bool is_queued, Bucket bucket);
    };

    void forget(uint32_t body);
    void ask_worst();
    void ask_cheapest();
    Step account(uint32_t body, const Step& step);
    void write(DrawList& out);

    Module module_;
    std::vector<ProgressiveMesh> meshes_;
    std::vector<Entry> bodies_;
    BodyQueue worst_, cheapest_;
    BucketScale scale_;
    std::vector<View> views_body_;
    StagedWrites staged_;
    bool is_first_view_ = true;
    uint64_t triangles_ = 0, emitted_ = 0;
};

}  // namespace lod
