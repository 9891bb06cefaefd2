// Decimation: collapses a manifold's edges one after the other, the least harmful first, and records how.
//
// Edges wait in a heap that is updated after each collapse. Safe is a collapse that keeps the surface a manifold (link
// condition), turns no triangle's normal by more than a threshold and leaves no triangle worse than another; the
// triangles that it removes are exempt. What is not safe waits until its surroundings change.
//
// Sources: Kalachev, Reshetnikova (see docs), steps 2 to 5; Garland, Heckbert (1997); Gueziec, Surface simplification
// inside a tolerance volume (1996) for the quality; half-edges: OpenMesh.
#pragma once

#include <functional>

#include "lod/progressive/collapse_step.h"
#include "lod/progressive/manifold_mesh.h"
#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

enum class CollapseMetric : uint8_t {
    kQuadric,    ///< squared distances to the planes of all triangles that went into the two ends
    kEdgeLength  ///< the source's: the shortest edge first, the new vertex in its middle
};

enum class CollapsePlace : uint8_t {
    kBest,  ///< where the metric is least
    kEnd    ///< at one of the two ends: all vertices of all levels are places of the full mesh
};

struct DecimateOptions {
    CollapseMetric metric = CollapseMetric::kQuadric;
    CollapsePlace place = CollapsePlace::kBest;
    double max_turn_cos = 0.5;  ///< a triangle's normal before and after: no smaller cosine than this
    double min_quality =
        0.02;  ///< 4 sqrt(3) area / (l0^2 + l1^2 + l2^2), 1 is equilateral; or as bad as before
    double border_weight =
        16.0;  ///< of planes that hold borders and breaks of colour, beside those of triangles
};

/// Collapses until nothing safe is left. The result has no errors, spheres and cones yet.
/// Borders move along themselves only; locked leaves do not move, and two of them do not become one.
/// Deterministic; ties go by edge length, then index.
/// @param follow  is told of every collapse as soon as it is recorded
/// Cost: about 6 us a collapse, without `follow`.
VertexHierarchy decimate(const ManifoldMesh& mesh, const DecimateOptions& options,
                         const std::function<void(const CollapseStep&)>& follow);

}  // namespace lod
