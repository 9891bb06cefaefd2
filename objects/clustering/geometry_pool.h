// GeometryPool: geometries as they are drawn, equal ones once.
#pragma once

#include <unordered_map>
#include <vector>

#include "data/timed_scene.h"
#include "lod/draw_list.h"
#include "objects/cluster_tree.h"
#include "objects/clustering/facing.h"
#include "objects/clustering/growing_array.h"
#include "objects/reduction/face_soup.h"

namespace objects {

/// One geometry by itself; indices of glass last.
struct DrawnGeometry {
    std::vector<lod::Vertex> vertices;
    std::vector<uint32_t> indices;
    uint32_t glass_index_count = 0;
    Facings facings;  ///< of what is not glass
};

/// A mesh of the scene, exactly: its own vertices, normals and colours. A triangle with a corner that is not opaque is
/// glass.
DrawnGeometry draw_mesh(const data::TimedMesh& mesh);

/// A soup: faces that meet at a gentle angle share a normal, others a place only; each face keeps its colour.
DrawnGeometry draw_soup(const FaceSoup& soup);

class GeometryPool {
  public:
    /// The number of a geometry with these bytes, new or known.
    uint32_t add(const DrawnGeometry& geometry);

    const std::vector<ClusterGeometry>& geometries() const { return geometries_; }
    /// Hands everything over.
    void move_to(ClusterTree& tree);

  private:
    bool is_equal(const ClusterGeometry& known, const DrawnGeometry& geometry) const;

    std::vector<ClusterGeometry> geometries_;
    std::vector<FacingRange> facings_;
    std::vector<Solid> solids_;
    GrowingArray<lod::Vertex> vertices_;
    GrowingArray<uint32_t> indices_;
    std::unordered_multimap<uint64_t, uint32_t> by_hash_;
};

}  // namespace objects
