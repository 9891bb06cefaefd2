#include "objects/clustering/facing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "objects/reduction/face_soup.h"
#include "objects/reduction/parts.h"

namespace objects {

namespace {

constexpr double kGapShare = 1e-5;         ///< of the extent: points that near are one
constexpr double kDentShare = 1e-5;        ///< … a corner may lie so far outside a face
constexpr size_t kMostFaces = 512;         ///< of a part that is looked at
constexpr size_t kFewestFaces = 8;         ///< of closed solids in a geometry: with fewer nothing is won
constexpr size_t kMostSolids = 4;          ///< of a geometry that are kept to hide what is behind them
constexpr double kSpreadSlack_rad = 1e-3;  ///< for roundings
constexpr float kSteepCos = 0.7f;          ///< what looks up or down more than that
constexpr uint32_t kRest = 0, kUp = 1, kFirstAround = 2, kAround = 16;
constexpr uint32_t kDown = kFirstAround + kAround, kBins = kDown + 1;

FaceSoup soup_of(std::span<const lod::Vertex> vertices, std::span<const uint32_t> indices) {
    FaceSoup soup;
    for (const lod::Vertex& vertex : vertices)
        soup.points.push_back(lod::position_of(vertex));
    for (size_t i = 0; i < indices.size(); i += 3)
        soup.faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
    soup.colours.resize(soup.faces.size());
    return soup;
}

/// Unit normal and offset: points x of the plane have dot(normal, x) = offset_m.
struct Plane {
    glm::dvec3 normal{0.0};
    double offset_m = 0.0;
};

Plane plane_of(const lod::Triangle& t) {
    const glm::dvec3 cross = glm::cross(t.b - t.a, t.c - t.a);
    const double length = glm::length(cross);
    if (!(length > 0.0)) return {};
    return {cross / length, glm::dot(cross / length, t.a)};
}

/// Whether no corner of the part lies outside any of its faces. A face without area looks nowhere.
bool is_convex(const FaceSoup& soup, std::span<const uint32_t> faces, double dent_m) {
    bool has_area = false;
    for (const uint32_t face : faces) {
        const Plane plane = plane_of(soup.view().triangle(face));
        has_area = has_area || plane.normal != glm::dvec3(0.0);
        for (const uint32_t other : faces) {
            for (const uint32_t corner : soup.faces[other]) {
                if (glm::dot(plane.normal, soup.points[corner]) > plane.offset_m + dent_m) return false;
            }
        }
    }
    return has_area;
}

uint32_t bin_of(const glm::dvec3& normal) {
    if (normal.z > double(kSteepCos)) return kUp;
    if (normal.z < -double(kSteepCos)) return kDown;
    const double share = 0.5 * (std::atan2(normal.y, normal.x) / std::numbers::pi + 1.0);
    return kFirstAround + std::min(static_cast<uint32_t>(kAround * share), kAround - 1);
}

/// Corners that reach farthest in sixteen directions, half of them upwards: the hull of some of a convex solid's corners
/// lies inside it.
Solid solid_of(const FaceSoup& soup, std::span<const uint32_t> faces) {
    Solid solid;
    for (uint32_t i = 0; i < Solid::kMostCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * double(i / 2) / (Solid::kMostCorners / 2);
        const glm::dvec3 direction(std::cos(angle), std::sin(angle), i % 2 == 0 ? 1.0 : -1.0);
        uint32_t farthest = soup.faces[faces[0]][0];
        for (const uint32_t face : faces) {
            for (const uint32_t corner : soup.faces[face]) {
                if (glm::dot(soup.points[corner] - soup.points[farthest], direction) > 0.0) farthest = corner;
            }
        }
        const auto end = solid.corners.begin() + solid.corner_count;
        if (std::find(solid.corners.begin(), end, farthest) == end)
            solid.corners[solid.corner_count++] = farthest;
    }
    return solid;
}

double width_m(const FaceSoup& soup, const Solid& solid) {
    glm::dvec3 low = soup.points[solid.corners[0]], high = low;
    for (uint32_t i = 1; i < solid.corner_count; ++i) {
        low = glm::min(low, soup.points[solid.corners[i]]);
        high = glm::max(high, soup.points[solid.corners[i]]);
    }
    return glm::length(high - low);
}

/// The largest ones, the very largest first.
void keep_largest(const FaceSoup& soup, std::vector<Solid>& solids) {
    std::stable_sort(solids.begin(), solids.end(),
                     [&soup](const Solid& a, const Solid& b) { return width_m(soup, a) > width_m(soup, b); });
    if (solids.size() > kMostSolids) solids.resize(kMostSolids);
}

/// The cone and the offset that all faces of a bin share.
FacingRange range_over(const FaceSoup& soup, std::span<const uint32_t> faces, const glm::dvec3& centre) {
    FacingRange range;
    range.index_count = static_cast<uint32_t>(3 * faces.size());
    glm::dvec3 sum(0.0);
    for (const uint32_t face : faces)
        sum += plane_of(soup.view().triangle(face)).normal;
    range.axis = glm::vec3(glm::normalize(sum));
    double cos = 1.0, least_m = std::numeric_limits<double>::infinity();
    for (const uint32_t face : faces) {
        const Plane plane = plane_of(soup.view().triangle(face));
        cos = std::min(cos, glm::dot(plane.normal, glm::dvec3(range.axis)));
        least_m = std::min(least_m, plane.offset_m - glm::dot(plane.normal, centre));
    }
    const double spread_rad = std::acos(std::clamp(cos, -1.0, 1.0)) + kSpreadSlack_rad;
    if (spread_rad < std::numbers::pi) range.spread_cos = static_cast<float>(std::cos(spread_rad));
    range.least_offset_m = static_cast<float>(least_m);
    return range;
}

}  // namespace

Facings sort_by_facing(std::span<const lod::Vertex> vertices, std::span<uint32_t> indices) {
    Facings out;
    if (indices.size() < 3 * kFewestFaces) return out;
    const FaceSoup soup = soup_of(vertices, indices);
    glm::dvec3 low = soup.points[indices[0]], high = low;
    for (const uint32_t i : indices) {
        low = glm::min(low, soup.points[i]);
        high = glm::max(high, soup.points[i]);
    }
    const double extent_m = glm::length(high - low);
    if (!(extent_m > 0.0)) return out;
    const WeldedSoup welded = weld(soup, kGapShare * extent_m);
    std::vector<std::vector<uint32_t>> bins(kBins);
    size_t closed = 0;
    for (const std::vector<uint32_t>& part : parts_of(soup, welded.point_of, welded.soup.points.size())) {
        const bool is_solid = part.size() <= kMostFaces && is_closed(soup, part, welded.point_of) &&
                              is_convex(soup, part, kDentShare * extent_m);
        closed += is_solid ? part.size() : 0;
        if (const Solid solid = is_solid ? solid_of(soup, part) : Solid{}; solid.corner_count >= 4)
            out.solids.push_back(solid);
        for (const uint32_t face : part) {
            const glm::dvec3 normal = plane_of(soup.view().triangle(face)).normal;
            bins[is_solid && normal != glm::dvec3(0.0) ? bin_of(normal) : kRest].push_back(face);
        }
    }
    if (closed < kFewestFaces) return {};
    keep_largest(soup, out.solids);
    const glm::dvec3 centre = 0.5 * (low + high);
    out.centre = glm::vec3(centre);
    out.radius_m = static_cast<float>(0.5 * extent_m * (1.0 + 1e-5));
    size_t next = 0;
    for (uint32_t bin = 0; bin < kBins; ++bin) {
        if (bins[bin].empty()) continue;
        FacingRange range{.index_count = static_cast<uint32_t>(3 * bins[bin].size())};
        if (bin != kRest) range = range_over(soup, bins[bin], glm::dvec3(out.centre));
        out.ranges.push_back(range);
        for (const uint32_t face : bins[bin]) {
            for (const uint32_t corner : soup.faces[face])
                indices[next++] = corner;
        }
    }
    return out;
}

}  // namespace objects
