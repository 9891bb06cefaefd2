// ground_query: what there is to know about the ground at a place, one by one or in batches.
//
// Everything is asked of the source data (data/ground_height.h), never of a mesh that is drawn: no camera, budget
// or level of detail changes a bit of an answer.
#pragma once

#include <cstdint>
#include <span>

#include "data/ground_height.h"
#include "data/height_grid.h"

namespace data {

/// What an answer rests on, by the three samples around the place.
enum class GroundKind : uint8_t {
    kMeasured,  ///< samples as the source has them
    kFilled,    ///< one of them at least was void and is filled: VoidPolicy::kFill
    kVoid,      ///< one of them at least is void; no ground is known
    kOutside    ///< beyond the source
};

/// The ground at a place.
struct GroundAnswer {
    double height_m = 0.0;  ///< kVoid: interpolated across the void; kOutside: 0
    glm::dvec3 normal_world{
        0.0};                ///< unit, upwards, of the triangle as drawn at full resolution; kOutside: 0.
                             ///< Level where it stands upright: samples of different heights at a pole
    double spacing_m = 0.0;  ///< between the samples it rests on, the larger way; kOutside: 0
    GroundKind kind = GroundKind::kOutside;

    bool is_valid() const { return kind == GroundKind::kMeasured || kind == GroundKind::kFilled; }
};

/// At a grid position; NaN is outside. Cost: about 100 ns, most of it the normal.
GroundAnswer ground_at_grid(const HeightGrid& grid, const glm::dvec2& place);

/// At sites; their heights count for nothing. out.size() == sites.size(). The same as one by one, for any
/// number of threads (threads >= 1). Cost: that, and PROJ's 1 us for projected rasters; threads take turns there.
void ground_at_sites(const HeightGrid& grid, std::span<const SitePoint> sites, std::span<GroundAnswer> out,
                     unsigned threads);
GroundAnswer ground_at_site(const HeightGrid& grid, const SitePoint& site);

/// Below, or above, world points: at their feet on the vertical. Otherwise as ground_at_sites.
void ground_under(const HeightGrid& grid, std::span<const glm::dvec3> world, std::span<GroundAnswer> out,
                  unsigned threads);
GroundAnswer ground_under(const HeightGrid& grid, const glm::dvec3& world);

}  // namespace data
