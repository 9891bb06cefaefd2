// RigidFront: parts of fixed geometry, drawn whole or not at all.
//
// What objects and instruments offer before they become adaptive: no operation to refine or coarsen, error 0
// (the source itself is drawn), culling by bounding sphere. A part belongs to a body; a body is a frame that
// may move every frame (a needle, a vehicle) while the part's vertices stay where they are in the pool.
#pragma once

#include <string>
#include <vector>

#include "lod/body_pose.h"
#include "lod/front.h"

namespace lod {

/// A piece of geometry with one bounding sphere; one draw item. Tens to some thousands of triangles.
struct RigidPart {
    uint32_t body = 0;
    std::vector<Vertex> vertices;   ///< body frame
    std::vector<uint32_t> indices;  ///< three per triangle, into `vertices`
    bool is_glass = false;
};

class RigidFront final : public Front {
  public:
    /// CHECKs that every part names a body and every index a vertex.
    RigidFront(Module module, std::vector<RigidPart> parts, std::vector<BodyPose> bodies);

    /// Moves a body; takes effect with the next emit.
    void set_pose(uint32_t body, const BodyPose& pose);

    /// Replaces vertices of a part, from the next emit on; its sphere follows. Undone by the vertices before, hash()
    /// included. CHECKs that the part has them.
    /// Cost: O(vertices of the part).
    void rewrite(uint32_t part, uint32_t first_vertex, std::span<const Vertex> vertices);

    /// For vertices of Material::kWallFoot: how far they are lowered this frame, px; what the caller allows for the
    /// ground's screen error.
    void set_ground_error_px(double error_px);

    /// The local vertical at the eye, world frame, not zero: the direction in which feet of walls are
    /// lowered.
    void set_up_world(const glm::dvec3& up_world);

    void begin_frame(std::span<const View> views, double time_s) override;
    double refine_error_px() override { return 0.0; }
    double coarsen_error_px() override;
    Step refine() override { return {}; }
    Step coarsen(double) override { return {}; }
    uint64_t triangles() const override { return triangles_; }
    double error_px() override { return 0.0; }
    OperationCounts operations() const override { return {}; }
    uint64_t hash() const override;
    PoolRegion pool_need() const override;
    void place(const PoolRegion& region) override;
    void emit(const View& view, DrawList& out) override;
    uint64_t emitted_triangles() const override { return emitted_; }
    std::string validate() const override;

  private:
    struct Placed {
        glm::dvec3 centre{0.0};  ///< body frame
        double radius_m = 0.0;
        uint32_t body = 0, first_vertex = 0, vertex_count = 0, first_index = 0, index_count = 0;
        bool is_glass = false;
    };
    bool is_outside(const Placed& part, const ViewMetric& metric) const;
    Instance instance_of(const BodyPose& pose, const View& view) const;
    void emit_writes(DrawList& out);

    Module module_;
    std::vector<Vertex> vertices_;
    std::vector<uint32_t> indices_;
    std::vector<Placed> parts_;
    std::vector<BodyPose> bodies_;
    std::vector<uint32_t> instance_of_body_;  ///< scratch of emit: the body's record in this view
    PoolRegion region_;
    bool is_written_ = false;
    struct VertexRange {
        uint32_t first = 0, count = 0;
    };
    std::vector<VertexRange> rewritten_;  ///< since the last emit
    double ground_error_px_ = 0.0;
    glm::dvec3 up_world_{0.0, 0.0, 1.0};
    uint64_t hash_ = 0;
    uint64_t triangles_ = 0, emitted_ = 0;
};

}  // namespace lod
