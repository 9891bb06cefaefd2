// WorldFrame: the scene's one world, and how site coordinates (what users write) become world metres.
//
// With a datum, site coordinates are longitude and latitude in degrees and height in metres above the WGS84
// ellipsoid, and the world is ECEF. Without one, site and world are the source's own x, y and height.
// Heights keep the datum of the terrain source: nothing here adds a geoid (docs/conventions.md).
#pragma once

#include <glm/glm.hpp>

namespace data {

/// A place as a user writes it: longitude/latitude degrees, or CRS x/y when the scene has no datum.
struct SitePoint {
    double x = 0.0;
    double y = 0.0;
    double height_m = 0.0;
};

/// Value type; no state but the kind.
struct WorldFrame {
    bool has_datum = true;

    /// @returns world metres; within 10 nm of GeographicLib's Geocentric for |height| < 5000 km
    glm::dvec3 world_from_site(const SitePoint& site) const;

    /// Inverse of world_from_site; longitude in [-180, 180]; the Earth's centre gives latitude 90.
    SitePoint site_from_world(const glm::dvec3& world) const;

    /// Columns east, north, up at `world`, orthonormal; east along the parallel also at the poles (longitude 0).
    glm::dmat3 world_from_enu(const glm::dvec3& world) const;
};

}  // namespace data
