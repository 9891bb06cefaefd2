#include "data/world_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <array>
#include <vector>

namespace data {

using GeographicLib::Geocentric;

glm::dvec3 WorldFrame::world_from_site(const SitePoint& site) const {
    if (!has_datum) return {site.x, site.y, site.height_m};
    glm::dvec3 world;
    Geocentric::WGS84().Forward(site.y, site.x, site.height_m, world.x, world.y, world.z);
    return world;
}

SitePoint WorldFrame::site_from_world(const glm::dvec3& world) const {
    if (!has_datum) return {world.x, world.y, world.z};
    SitePoint site;
    Geocentric::WGS84().Reverse(world.x, world.y, world.z, site.y, site.x, site.height_m);
    return site;
}

glm::dmat3 WorldFrame::world_from_enu(const glm::dvec3& world) const {
    if (!has_datum) return glm::dmat3(1.0);
    double latitude = 0.0, longitude = 0.0, height_m = 0.0;
    std::vector<double> m(9);  // row-major
    Geocentric::WGS84().Reverse(world.x, world.y, world.z, latitude, longitude, height_m, m);
    return {{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}};
}

}  // namespace data
