#include "objects/clustering/geometry_pool.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "lod/base/check.h"
#include "lod/base/hash.h"
#include "objects/reduction/finish.h"

namespace objects {

namespace {

constexpr double kCreaseCos = 0.86;          ///< faces within 30 degrees look like one bent surface
constexpr uint32_t kUnplaced = 0xffffffffu;  ///< no triangle has used the vertex so far

lod::Material material_of(uint8_t alpha) {
    return alpha < 255 ? lod::Material::kGlass : lod::Material::kPaint;
}

template <typename T>
uint64_t hash_array(const std::vector<T>& array, uint64_t hash) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(array.data());
    return lod::hash_bytes({bytes, array.size() * sizeof(T)}, lod::hash_combine(hash, array.size()));
}

uint64_t hash_of(const DrawnGeometry& geometry) {
    return hash_array(geometry.indices, hash_array(geometry.vertices, geometry.glass_index_count));
}

/// Corners of faces by the point they lie on: [points + 1] ranges, and face * 3 + corner.
struct CornersOfPoints {
    std::vector<uint32_t> begin, corners;

    explicit CornersOfPoints(const FaceSoup& soup) : begin(soup.points.size() + 1, 0) {
        for (const auto& face : soup.faces) {
            for (uint32_t point : face)
                ++begin[point + 1];
        }
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        corners.resize(3 * soup.faces.size());
        std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
        for (uint32_t face = 0; face < soup.faces.size(); ++face) {
            for (uint32_t k = 0; k < 3; ++k)
                corners[next[soup.faces[face][k]]++] = 3 * face + k;
        }
    }
};

std::vector<glm::dvec3> cross_products(const FaceSoup& soup) {
    std::vector<glm::dvec3> cross(soup.faces.size());
    for (size_t face = 0; face < cross.size(); ++face) {
        const lod::Triangle t = soup.view().triangle(face);
        cross[face] = glm::cross(t.b - t.a, t.c - t.a);
    }
    return cross;
}

/// Mean direction of the faces around a point that meet this one gently, weighted by area; sides do not count, surfaces
/// are drawn from both.
glm::vec3 bent_normal(const std::vector<glm::dvec3>& cross, std::span<const uint32_t> corners,
                      uint32_t face) {
    const glm::dvec3 own = cross[face];
    const double length = std::sqrt(glm::dot(own, own));
    if (!(length > 0.0)) return glm::vec3(0.0f, 0.0f, 1.0f);
    glm::dvec3 sum(0.0);
    for (uint32_t corner : corners) {
        const glm::dvec3& other = cross[corner / 3];
        const double dot = glm::dot(own, other), other_length = std::sqrt(glm::dot(other, other));
        if (std::abs(dot) >= kCreaseCos * length * other_length) sum += dot < 0.0 ? -other : other;
    }
    return glm::vec3(sum / std::sqrt(glm::dot(sum, sum)));
}

/// Vertices in the order of their first use, so that a range of triangles has its own; what no triangle uses goes.
void sort_vertices(DrawnGeometry& drawn) {
    std::vector<uint32_t> place(drawn.vertices.size(), kUnplaced);
    std::vector<lod::Vertex> sorted;
    sorted.reserve(drawn.vertices.size());
    for (uint32_t& index : drawn.indices) {
        if (place[index] == kUnplaced) {
            place[index] = static_cast<uint32_t>(sorted.size());
            sorted.push_back(drawn.vertices[index]);
        }
        index = place[index];
    }
    drawn.vertices = std::move(sorted);
    for (Solid& solid : drawn.facings.solids) {
        for (uint32_t i = 0; i < solid.corner_count; ++i)
            solid.corners[i] = place[solid.corners[i]];
    }
}

/// Puts what is not glass into the order of where it looks.
void settle_order(DrawnGeometry& drawn) {
    const size_t opaque = drawn.indices.size() - drawn.glass_index_count;
    drawn.facings = sort_by_facing(drawn.vertices, std::span(drawn.indices).first(opaque));
    sort_vertices(drawn);
}

}  // namespace

DrawnGeometry draw_mesh(const data::TimedMesh& mesh) {
    DrawnGeometry drawn;
    drawn.vertices.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::u8vec4 colour = mesh.colours[i];
        drawn.vertices.push_back(lod::make_vertex(glm::dvec3(mesh.positions[i]), mesh.normals[i],
                                                  glm::u8vec3(colour.x, colour.y, colour.z),
                                                  material_of(colour.w)));
    }
    const auto is_glass = [&](const std::array<uint32_t, 3>& triangle) {
        return std::any_of(triangle.begin(), triangle.end(),
                           [&](uint32_t i) { return mesh.colours[i].w < 255; });
    };
    for (const bool glass : {false, true}) {
        for (const auto& triangle : mesh.triangles) {
            if (is_glass(triangle) != glass) continue;
            drawn.indices.insert(drawn.indices.end(), triangle.begin(), triangle.end());
            if (glass) drawn.glass_index_count += 3;
        }
    }
    settle_order(drawn);
    return drawn;
}

DrawnGeometry draw_soup(const FaceSoup& soup) {
    DrawnGeometry drawn;
    const CornersOfPoints around(soup);
    const std::vector<glm::dvec3> cross = cross_products(soup);
    std::vector<uint32_t> vertex_of(3 * soup.faces.size());
    for (size_t point = 0; point < soup.points.size(); ++point) {
        const std::span<const uint32_t> corners(around.corners.data() + around.begin[point],
                                                around.begin[point + 1] - around.begin[point]);
        const size_t first = drawn.vertices.size();
        for (uint32_t corner : corners) {
            const glm::u8vec4 colour = soup.colours[corner / 3];
            const lod::Vertex vertex =
                is_all_round(colour)
                    ? lod::make_all_round_vertex(soup.points[point], up_share(colour), glm::u8vec3(colour))
                    : lod::make_vertex(soup.points[point], bent_normal(cross, corners, corner / 3),
                                       glm::u8vec3(colour), material_of(colour.w));
            size_t same = first;
            while (same < drawn.vertices.size() &&
                   std::memcmp(&drawn.vertices[same], &vertex, sizeof vertex) != 0)
                ++same;
            if (same == drawn.vertices.size()) drawn.vertices.push_back(vertex);
            vertex_of[corner] = static_cast<uint32_t>(same);
        }
    }
    for (const bool glass : {false, true}) {
        for (size_t face = 0; face < soup.faces.size(); ++face) {
            if (is_glass(soup.colours[face]) != glass) continue;
            for (size_t k = 0; k < 3; ++k)
                drawn.indices.push_back(vertex_of[3 * face + k]);
            if (glass) drawn.glass_index_count += 3;
        }
    }
    settle_order(drawn);
    return drawn;
}

bool GeometryPool::is_equal(const ClusterGeometry& known, const DrawnGeometry& geometry) const {
    if (known.vertex_count != geometry.vertices.size() || known.index_count != geometry.indices.size() ||
        known.glass_index_count != geometry.glass_index_count)
        return false;
    const std::span<const uint32_t> indices = indices_.at(known.first_index, known.index_count);
    const std::span<const lod::Vertex> vertices = vertices_.at(known.first_vertex, known.vertex_count);
    return std::equal(indices.begin(), indices.end(), geometry.indices.begin()) &&
           (vertices.empty() ||
            std::memcmp(geometry.vertices.data(), vertices.data(), vertices.size_bytes()) == 0);
}

uint32_t GeometryPool::add(const DrawnGeometry& geometry) {
    const uint64_t hash = hash_of(geometry);
    const auto [begin, end] = by_hash_.equal_range(hash);
    for (auto it = begin; it != end; ++it) {
        if (is_equal(geometries_[it->second], geometry)) return it->second;
    }
    CHECK(vertices_.size() + geometry.vertices.size() < 0xffffffffu);
    CHECK(indices_.size() + geometry.indices.size() < 0xffffffffu);
    ClusterGeometry added;
    added.vertex_count = static_cast<uint32_t>(geometry.vertices.size());
    added.index_count = static_cast<uint32_t>(geometry.indices.size());
    added.glass_index_count = geometry.glass_index_count;
    added.first_vertex = static_cast<uint32_t>(vertices_.append(geometry.vertices));
    added.first_index = static_cast<uint32_t>(indices_.append(geometry.indices));
    added.first_facing = static_cast<uint32_t>(facings_.size());
    added.facing_count = static_cast<uint32_t>(geometry.facings.ranges.size());
    added.centre = geometry.facings.centre;
    added.radius_m = geometry.facings.radius_m;
    facings_.insert(facings_.end(), geometry.facings.ranges.begin(), geometry.facings.ranges.end());
    added.first_solid = static_cast<uint32_t>(solids_.size());
    added.solid_count = static_cast<uint32_t>(geometry.facings.solids.size());
    solids_.insert(solids_.end(), geometry.facings.solids.begin(), geometry.facings.solids.end());
    const uint32_t id = static_cast<uint32_t>(geometries_.size());
    geometries_.push_back(added);
    by_hash_.emplace(hash, id);
    return id;
}

void GeometryPool::move_to(ClusterTree& tree) {
    tree.geometries = std::move(geometries_);
    tree.facings = std::move(facings_);
    tree.solids = std::move(solids_);
    tree.vertices = vertices_.release();
    tree.indices = indices_.release();
    *this = GeometryPool();
}

}  // namespace objects
