#include "data/solid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <string_view>

namespace data {

namespace {

constexpr double kSmooth = 0.82;  // cosine above which neighbouring faces share a normal

uint32_t append_vertex(const SolidTarget& target, const glm::dvec3& position, const glm::dvec3& normal) {
    MeshNode& node = target.mesh->nodes[target.node];
    const glm::vec4 colour = target.mesh->materials[target.material].colour * 255.0f + 0.5f;
    node.positions.emplace_back(target.node_from_solid * glm::dvec4(position, 1.0));
    node.normals.emplace_back(glm::normalize(glm::dmat3(target.node_from_solid) * normal));
    node.colours.emplace_back(colour);
    return static_cast<uint32_t>(node.positions.size() - 1);
}

void append_triangle(const SolidTarget& target, uint32_t a, uint32_t b, uint32_t c) {
    MeshNode& node = target.mesh->nodes[target.node];
    const glm::vec3 &p = node.positions[a], &q = node.positions[b], &r = node.positions[c];
    if (p == q || q == r || r == p) return;
    node.triangles.push_back({a, b, c});
    node.triangle_material.push_back(target.material);
}

/// Two corners of a strip of quadrilaterals: a position and a normal each.
struct Corner {
    glm::dvec3 position;
    glm::dvec3 normal;
};

/// a, b, c, d counter-clockwise outside.
void append_quad(const SolidTarget& target, const Corner& a, const Corner& b, const Corner& c,
                 const Corner& d) {
    const uint32_t first = append_vertex(target, a.position, a.normal);
    append_vertex(target, b.position, b.normal);
    append_vertex(target, c.position, c.normal);
    append_vertex(target, d.position, d.normal);
    append_triangle(target, first, first + 1, first + 2);
    append_triangle(target, first, first + 2, first + 3);
}

void append_flat_triangle(const SolidTarget& target, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (glm::length(normal) < 1e-16) return;
    const uint32_t first = append_vertex(target, a, normal);
    append_vertex(target, b, normal);
    append_vertex(target, c, normal);
    append_triangle(target, first, first + 1, first + 2);
}

glm::dvec2 outward(const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = glm::normalize(b - a);
    return {along.y, -along.x};
}

/// A ring's outward directions: at each point towards its own mitre, and per edge end the shading direction.
struct RingNormals {
    std::vector<glm::dvec2> mitre;       ///< [points], length 1/cos(half the turn), at most 2
    std::vector<glm::dvec2> begin, end;  ///< [edges], shading direction at the edge's ends
};

RingNormals ring_normals(const Polyline& ring) {
    const size_t count = ring.size();
    std::vector<glm::dvec2> edge(count);
    for (size_t i = 0; i < count; ++i)
        edge[i] = outward(ring[i], ring[(i + 1) % count]);
    RingNormals normals{std::vector<glm::dvec2>(count), edge, edge};
    for (size_t i = 0; i < count; ++i) {
        const size_t before = (i + count - 1) % count;
        const glm::dvec2 sum = edge[before] + edge[i];
        const double cosine = glm::dot(edge[before], edge[i]);
        normals.mitre[i] = cosine > -0.5 ? sum / (1.0 + cosine) : edge[i];
        if (cosine < kSmooth) continue;
        normals.end[before] = normals.begin[i] = glm::normalize(sum);
    }
    return normals;
}

/// Edges shorter than the bevel would turn round when moved inwards: their ends meet in the middle instead.
void unfold(const Polyline& ring, Polyline& inset) {
    constexpr int kPasses = 4;
    for (int pass = 0; pass < kPasses; ++pass) {
        for (size_t i = 0; i < ring.size(); ++i) {
            const size_t next = (i + 1) % ring.size();
            if (glm::dot(inset[next] - inset[i], ring[next] - ring[i]) >= 0.0) continue;
            inset[i] = inset[next] = (inset[i] + inset[next]) / 2.0;
        }
    }
}

/// The side of an extrusion along one ring, and its bevel; returns the ring of the upper face.
Polyline append_side(const Polyline& ring, const Extrusion& shape, const SolidTarget& target) {
    const RingNormals normals = ring_normals(ring);
    const double shoulder = shape.z1 - shape.bevel;
    Polyline inset(ring.size());
    for (size_t i = 0; i < ring.size(); ++i)
        inset[i] = ring[i] - shape.bevel * normals.mitre[i];
    unfold(ring, inset);
    for (size_t i = 0; i < ring.size(); ++i) {
        const size_t next = (i + 1) % ring.size();
        const glm::dvec2 n0 = normals.begin[i], n1 = normals.end[i];
        const auto corner = [](const glm::dvec2& at, double z, const glm::dvec2& n, double up) {
            return Corner{glm::dvec3(at, z), glm::dvec3(n, up)};
        };
        append_quad(target, corner(ring[i], shape.z0, n0, 0), corner(ring[next], shape.z0, n1, 0),
                    corner(ring[next], shoulder, n1, 0), corner(ring[i], shoulder, n0, 0));
        if (shape.bevel <= 0.0) continue;
        append_quad(target, corner(ring[i], shoulder, n0, 1), corner(ring[next], shoulder, n1, 1),
                    corner(inset[next], shape.z1, n1, 1), corner(inset[i], shape.z1, n0, 1));
    }
    return inset;
}

/// Normals of a profile at both ends of each of its edges.
RingNormals profile_normals(std::span<const glm::dvec2> profile) {
    RingNormals normals;
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::dvec2 along = glm::normalize(profile[i + 1] - profile[i]);
        normals.begin.push_back({-along.y, along.x});  // left of the way outwards: up
    }
    normals.end = normals.begin;
    for (size_t i = 1; i < normals.begin.size(); ++i) {
        const glm::dvec2 before = normals.end[i - 1], after = normals.begin[i];
        if (glm::dot(before, after) < kSmooth) continue;
        normals.end[i - 1] = normals.begin[i] = glm::normalize(before + after);
    }
    return normals;
}

}  // namespace

void append_extrusion(const Shape& shape, const Extrusion& extrusion, const SolidTarget& target) {
    for (const Outline& outline : shape) {
        Polyline face;
        for (const Polyline& ring : outline.rings) {
            const Polyline inset = append_side(ring, extrusion, target);
            face.insert(face.end(), inset.begin(), inset.end());
        }
        const uint32_t first = static_cast<uint32_t>(target.mesh->nodes[target.node].positions.size());
        for (const glm::dvec2& point : face) {
            append_vertex(target, glm::dvec3(point, extrusion.z1), glm::dvec3(0, 0, 1));
        }
        for (const auto& [a, b, c] : outline.triangles) {
            append_triangle(target, first + a, first + b, first + c);
        }
    }
}

void append_lathe(std::span<const glm::dvec2> profile, int segments, const SolidTarget& target) {
    const RingNormals normals = profile_normals(profile);
    const auto corner = [&](const glm::dvec2& at, const glm::dvec2& normal, int segment) {
        const double angle = 2.0 * std::numbers::pi * (segment % segments) / segments;
        const glm::dvec3 out(std::cos(angle), std::sin(angle), 0.0);
        return Corner{at.x * out + glm::dvec3(0, 0, at.y), normal.x * out + glm::dvec3(0, 0, normal.y)};
    };
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
        for (int segment = 0; segment < segments; ++segment) {
            append_quad(target, corner(profile[i], normals.begin[i], segment),
                        corner(profile[i + 1], normals.end[i], segment),
                        corner(profile[i + 1], normals.end[i], segment + 1),
                        corner(profile[i], normals.begin[i], segment + 1));
        }
    }
}

void append_needle(std::span<const glm::dvec2> stations, const NeedleBody& body, const SolidTarget& target) {
    const auto at = [](const glm::dvec2& station, double side, double z) {
        return glm::dvec3(side * station.y, station.x, z);
    };
    for (size_t i = 0; i + 1 < stations.size(); ++i) {
        const glm::dvec2 &near = stations[i], &far = stations[i + 1];
        const auto ridge = [&](const glm::dvec2& s) {
            return glm::dvec3(0.0, s.x, s.y > 0.0 ? body.z_ridge : body.z1);
        };
        for (const double side : {-1.0, 1.0}) {
            const glm::dvec3 low_near = at(near, side, body.z0), low_far = at(far, side, body.z0);
            const glm::dvec3 top_near = at(near, side, body.z1), top_far = at(far, side, body.z1);
            const bool right = side > 0.0;
            const auto face = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
                append_flat_triangle(target, a, right ? b : c, right ? c : b);
            };
            face(low_near, low_far, top_far);
            face(low_near, top_far, top_near);
            face(top_near, top_far, ridge(far));
            face(top_near, ridge(far), ridge(near));
        }
    }
    const auto cap = [&](const glm::dvec2& s, bool is_far) {
        const glm::dvec3 left = at(s, -1.0, body.z1), right = at(s, 1.0, body.z1);
        const glm::dvec3 low_left = at(s, -1.0, body.z0), low_right = at(s, 1.0, body.z0);
        const glm::dvec3 top(0.0, s.x, body.z_ridge);
        const auto face = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            append_flat_triangle(target, a, is_far ? c : b, is_far ? b : c);
        };
        face(low_left, low_right, right);
        face(low_left, right, left);
        face(left, right, top);
    };
    if (stations.front().y > 0.0) cap(stations.front(), false);
    if (stations.back().y > 0.0) cap(stations.back(), true);
}

uint32_t add_node(PolygonMesh& mesh, const std::string& name, int32_t parent,
                  const glm::dmat4& parent_from_node) {
    MeshNode node;
    node.name = name;
    node.parent = parent;
    node.parent_from_node = parent_from_node;
    mesh.nodes.push_back(std::move(node));
    return static_cast<uint32_t>(mesh.nodes.size() - 1);
}

uint32_t add_material(PolygonMesh& mesh, const std::string& name, const glm::vec4& colour) {
    MeshMaterial material;
    material.name = name;
    material.colour = colour;
    mesh.materials.push_back(std::move(material));
    return static_cast<uint32_t>(mesh.materials.size() - 1);
}

void weld(MeshNode& node) {
    using Key = std::array<uint32_t, 7>;
    std::map<Key, uint32_t> kept;
    std::vector<uint32_t> target(node.positions.size());
    MeshNode welded;
    for (size_t i = 0; i < node.positions.size(); ++i) {
        Key key{};
        std::memcpy(&key[0], &node.positions[i], 12);
        std::memcpy(&key[3], &node.normals[i], 12);
        std::memcpy(&key[6], &node.colours[i], 4);
        const auto [place, is_new] = kept.emplace(key, static_cast<uint32_t>(welded.positions.size()));
        target[i] = place->second;
        if (!is_new) continue;
        welded.positions.push_back(node.positions[i]);
        welded.normals.push_back(node.normals[i]);
        welded.colours.push_back(node.colours[i]);
    }
    for (auto& triangle : node.triangles) {
        for (uint32_t& corner : triangle)
            corner = target[corner];
    }
    node.positions = std::move(welded.positions);
    node.normals = std::move(welded.normals);
    node.colours = std::move(welded.colours);
}

}  // namespace data
