#include "data/scenes/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "lod/base/check.h"
#include "lod/base/rng.h"

namespace data {

namespace {

uint32_t append_vertex(const glm::dvec3& position, const glm::dvec3& normal, const Colour& colour,
                       TimedMesh& mesh) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    mesh.colours.emplace_back(colour, uint8_t{255});
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

/// A flat quadrilateral, counter-clockwise outside.
void append_quad(const std::array<glm::dvec3, 4>& corners, const Colour& colour, TimedMesh& mesh) {
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const uint32_t first = append_vertex(corners[0], normal, colour, mesh);
    for (size_t i = 1; i < 4; ++i)
        append_vertex(corners[i], normal, colour, mesh);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

/// The six sides of the box spanned by three half axes, right-handed, around a centre.
void append_hexahedron(const glm::dvec3& centre, const std::array<glm::dvec3, 3>& half, const Colour& colour,
                       TimedMesh& mesh) {
    for (size_t axis = 0; axis < 3; ++axis) {
        const glm::dvec3 &out = half[axis], &u = half[(axis + 1) % 3], &v = half[(axis + 2) % 3];
        append_quad({centre + out - u - v, centre + out + u - v, centre + out + u + v, centre + out - u + v},
                    colour, mesh);
        append_quad({centre - out - u - v, centre - out - u + v, centre - out + u + v, centre - out + u - v},
                    colour, mesh);
    }
}

/// Two unit vectors that make a right-handed frame with `along`: the first is level unless `along` is vertical.
std::array<glm::dvec3, 2> across(const glm::dvec3& along) {
    const bool is_vertical = std::abs(along.x) + std::abs(along.y) < 1e-9;
    const glm::dvec3 up = is_vertical ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 level = glm::normalize(glm::cross(up, along));
    return {level, glm::cross(along, level)};
}

/// A closed ring of vertices already in the mesh.
struct Ring {
    uint32_t first = 0, count = 0;

    uint32_t at(uint32_t i) const { return first + i % count; }
};

/// Joins two rings that begin at the same angle with outer.count + inner.count triangles.
void append_strip(const Ring& outer, const Ring& inner, TimedMesh& mesh) {
    for (uint32_t o = 0, i = 0; o < outer.count || i < inner.count;) {
        const bool is_outer_next = uint64_t{o + 1} * inner.count <= uint64_t{i + 1} * outer.count;
        if (i == inner.count || (is_outer_next && o < outer.count)) {
            mesh.triangles.push_back({outer.at(o), outer.at(o + 1), inner.at(i)});
            ++o;
        } else {
            mesh.triangles.push_back({outer.at(o), inner.at(i + 1), inner.at(i)});
            ++i;
        }
    }
}

}  // namespace

void append_box(const glm::dvec3& low, const glm::dvec3& high, const Colour& colour, TimedMesh& mesh) {
    const glm::dvec3 half = (high - low) / 2.0;
    append_hexahedron((low + high) / 2.0,
                      {glm::dvec3(half.x, 0, 0), glm::dvec3(0, half.y, 0), glm::dvec3(0, 0, half.z)}, colour,
                      mesh);
}

void append_bar(const Bar& bar, const Colour& colour, TimedMesh& mesh) {
    const glm::dvec3 along = glm::normalize(bar.to - bar.from);
    const auto [level, other] = across(along);
    append_hexahedron((bar.from + bar.to) / 2.0,
                      {(bar.to - bar.from) / 2.0, level * (bar.width / 2.0), other * (bar.height / 2.0)},
                      colour, mesh);
}

void append_tube(const Tube& tube, const Colour& colour, TimedMesh& mesh) {
    CHECK(tube.sides >= 3);
    const auto sides = static_cast<uint32_t>(tube.sides);
    const glm::dvec3 along = glm::normalize(tube.to - tube.from);
    const auto [level, other] = across(along);
    const auto ring = [&](const glm::dvec3& centre, const glm::dvec3* flat_normal) {
        const Ring result{static_cast<uint32_t>(mesh.positions.size()), sides};
        for (uint32_t i = 0; i < sides; ++i) {
            const double angle_rad = 2.0 * std::numbers::pi * i / sides;
            const glm::dvec3 out = std::cos(angle_rad) * level + std::sin(angle_rad) * other;
            append_vertex(centre + tube.radius * out, flat_normal ? *flat_normal : out, colour, mesh);
        }
        return result;
    };
    const Ring from = ring(tube.from, nullptr), to = ring(tube.to, nullptr);
    append_strip(from, to, mesh);
    const glm::dvec3 back = -along;
    const Ring lower = ring(tube.from, &back), upper = ring(tube.to, &along);
    for (uint32_t i = 1; i + 1 < sides; ++i) {
        mesh.triangles.push_back({lower.at(0), lower.at(i + 1), lower.at(i)});
        mesh.triangles.push_back({upper.at(0), upper.at(i), upper.at(i + 1)});
    }
}

void append_heap(const Heap& heap, const Colour& colour, TimedMesh& mesh) {
    CHECK(heap.triangles >= 9);
    const auto inner_count = static_cast<uint32_t>(heap.triangles / 3);
    const auto outer_count = static_cast<uint32_t>(heap.triangles) - 2 * inner_count;
    lod::Rng rng(heap.triangles);
    const auto ring = [&](uint32_t count, double radius, double height) {
        const Ring result{static_cast<uint32_t>(mesh.positions.size()), count};
        for (uint32_t i = 0; i < count; ++i) {
            const double angle_rad = 2.0 * std::numbers::pi * i / count, wobble = rng.between(0.88, 1.08);
            const glm::dvec3 out(std::cos(angle_rad), std::sin(angle_rad), 0.0);
            const glm::dvec3 normal =
                glm::normalize(glm::dvec3(heap.height * out.x, heap.height * out.y, heap.radius));
            append_vertex(radius * wobble * out + glm::dvec3(0, 0, height * wobble), normal, colour, mesh);
        }
        return result;
    };
    const Ring outer = ring(outer_count, heap.radius, 0.0);
    const Ring inner = ring(inner_count, 0.45 * heap.radius, 0.72 * heap.height);
    const uint32_t top = append_vertex({0.0, 0.0, heap.height}, {0.0, 0.0, 1.0}, colour, mesh);
    append_strip(outer, inner, mesh);
    for (uint32_t i = 0; i < inner_count; ++i)
        mesh.triangles.push_back({inner.at(i), inner.at(i + 1), top});
}

void append_lump(const glm::dvec3& centre, const glm::dvec3& half, const Colour& colour, TimedMesh& mesh) {
    constexpr double kGolden = std::numbers::phi;
    const std::array<glm::dvec3, 12> corners = {{{-1, kGolden, 0},
                                                 {1, kGolden, 0},
                                                 {-1, -kGolden, 0},
                                                 {1, -kGolden, 0},
                                                 {0, -1, kGolden},
                                                 {0, 1, kGolden},
                                                 {0, -1, -kGolden},
                                                 {0, 1, -kGolden},
                                                 {kGolden, 0, -1},
                                                 {kGolden, 0, 1},
                                                 {-kGolden, 0, -1},
                                                 {-kGolden, 0, 1}}};
    constexpr std::array<std::array<uint32_t, 3>, 20> kFaces = {
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const auto append_direction = [&](const glm::dvec3& toward) {
        const glm::dvec3 direction = glm::normalize(toward);
        return append_vertex(centre + half * direction, glm::normalize(direction / half), colour, mesh) -
               first;
    };
    for (const glm::dvec3& corner : corners)
        append_direction(corner);
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), 0u);
        if (is_new) place->second = append_direction(corners[a] + corners[b]);
        return place->second;
    };
    for (const auto& [a, b, c] : kFaces) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const auto& [p, q, r] :
             {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
            mesh.triangles.push_back({first + p, first + q, first + r});
    }
}

}  // namespace data
