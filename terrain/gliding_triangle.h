// How far a triangle of the mesh is off while vertices glide: hardly farther than the meshes it lies between.
//
// A vertex that glides is shown between its place and the edge it was born on, a share w of the way back. At any point its
// triangle is then shown between two others: the one with the vertex at its place, of weight 1 - w, and its parent in
// the bintree, of weight w, which lies there without the vertex. A mean of two surfaces is off by no more than the mean
// of what they are off:
//
//     off(triangle) <= (1 - w) (error of the mesh + ways of the older two corners) + w off(parent)
//     off(parent)   likewise, with the error of the diamond that was split
//     off(triangle) <= error + ways of all its corners    always; for a parent whose apex does not glide, or does from
//                                                         beside its edge, there is nothing better
//
// So a vertex that glides among others that do not costs nothing beyond the errors without it and with it.
#pragma once

#include <algorithm>

#include "terrain/bintree_triangle.h"
#include "terrain/vertex_glides.h"

namespace terrain {

/// @param t         in the mesh
/// @param error_px  of the mesh as it is without gliding, at least of the triangle
/// @param way_px    (glide, triangle): pixels that the glide's displacement costs on a triangle that has it as a corner
/// @return pixels that the triangle is off as it is shown, at most
/// Cost: some 100 ns, and as much again for each generation that glides at once.
template <typename WayPx>
double gliding_error_px(const DiamondMesh& mesh, const VertexGlides& glides, BintreeTriangle t,
                        double error_px, const WayPx& way_px) {
    const auto glide_of = [&](DiamondIndex vertex) {
        return glides.find(vertex, static_cast<int>(mesh[vertex].level));
    };
    const auto way_of = [&](const VertexGlide* glide) { return glide == nullptr ? 0.0 : way_px(*glide, t); };
    const auto older_ways_px = [&] { return way_of(glide_of(t.left)) + way_of(glide_of(t.right)); };

    const VertexGlide* glide = glide_of(t.apex);
    const double plain_px = error_px + older_ways_px() + way_of(glide);
    double off_px = 0.0, share = 1.0;
    while (glide != nullptr && glide->base.is_middle()) {
        const double weight = double(glide->weight);
        off_px += share * (1.0 - weight) * (error_px + older_ways_px());
        share *= weight;
        error_px = double(glide->error_px);
        t = parent_of(mesh, t);
        glide = glide_of(t.apex);
    }
    off_px += share * (error_px + older_ways_px() + way_of(glide));
    return std::min(off_px, plain_px);
}

}  // namespace terrain
