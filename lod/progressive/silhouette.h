// Silhouette: whether some normal within a cone may stand square to some line of sight to a sphere, and how far the
// eye may move before one that does not, does.
//
// With axis n, half angle alpha, v the direction from the eye to the sphere's centre and beta the sphere's half
// angle: no silhouette where |n . v| > sin(alpha + beta). When the eye moves by s, v turns by at most s / d and
// sin(alpha + beta) grows by at most 0.6 s / d while the sphere is more than two radii away; hence the half below,
// which leaves room for d shrinking by a fifth.
//
// Source: Hoppe, View-dependent refinement of progressive meshes (1997), section 4.3; Luebke, Erikson (1997).
#pragma once

#include <span>

#include "lod/progressive/mesh_tables.h"
#include "lod/sight_metric.h"

namespace lod {

/// Cones of normals, four side by side.
struct FourCones {
    Float4 x{}, y{}, z{}, cos{};

    void set(int lane, const NodeBound& bound) {
        x[lane] = bound.cone_axis.x;
        y[lane] = bound.cone_axis.y;
        z[lane] = bound.cone_axis.z;
        cos[lane] = bound.cone_cos;
    }
};

struct FourSilhouettes {
    Int4 is_silhouette{};                      ///< mask: for one eye at least
    Float4 guard_m = splat(FourSights::kFar);  ///< of those that are none: displacement that keeps them so
};

/// Closer than this to becoming one counts as one, so that nothing creeps up to the edge in ever shorter steps.
inline constexpr float kSilhouetteMargin = 0.02f;

inline FourSilhouettes silhouettes(const FourBounds& bound, const FourCones& cone,
                                   std::span<const AnchoredEye> eyes) {
    FourSilhouettes result;
    const Float4 one = splat(1.0f), zero{};
    const Float4 sin_cone = sqrt(max(one - cone.cos * cone.cos, zero));
    for (const AnchoredEye& eye : eyes) {
        const Float4 x = bound.x - eye.eye_f.x, y = bound.y - eye.eye_f.y, z = bound.z - eye.eye_f.z;
        const Float4 distance = sqrt(x * x + y * y + z * z);
        const Float4 away = max(distance, splat(1e-30f));
        const Float4 sin_sphere = min(bound.radius_m / away, one);
        const Float4 cos_sphere = sqrt(one - sin_sphere * sin_sphere);
        const Float4 facing = abs(cone.x * x + cone.y * y + cone.z * z) / away;
        const Float4 room =
            facing - (sin_cone * cos_sphere + cone.cos * sin_sphere) - splat(kSilhouetteMargin);
        const Int4 is_wide = (cone.cos <= 0.0f) | (sin_cone >= cos_sphere) | (sin_sphere > 0.5f);
        result.is_silhouette |= is_wide | (room <= 0.0f);
        result.guard_m = min(result.guard_m, room * distance * 0.5f);
    }
    return result;
}

}  // namespace lod
