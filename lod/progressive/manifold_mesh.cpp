#include "lod/progressive/manifold_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "lod/base/hash.h"
#include "lod/progressive/face_sheets.h"
#include "lod/progressive/weld.h"

namespace lod {
namespace {

using Corners = std::array<uint32_t, 3>;
constexpr uint32_t kNone = 0xffffffffu;

/// A set of numbers that joins; the least is its name.
class UnionFind {
  public:
    explicit UnionFind(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    uint32_t find(uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(uint32_t a, uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<uint32_t> parent_;
};

Result<Ok> check_input(const SurfaceMesh& mesh) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return Error{"vertex " + std::to_string(i) +
                         " has a coordinate that is no number; expected finite ones"};
    }
    for (const Corners& triangle : mesh.triangles) {
        for (uint32_t corner : triangle) {
            if (corner >= mesh.positions.size())
                return Error{"a triangle names vertex " + std::to_string(corner) + "; expected one of " +
                             std::to_string(mesh.positions.size())};
        }
    }
    return Ok{};
}

/// Triangles that are all different; chains of a hash table over plain arrays.
class FaceSet {
  public:
    explicit FaceSet(size_t most) : first_(std::bit_ceil(most + 1), kNone) {}
    /// Whether it was not there yet.
    bool insert(const Corners& face) {
        const uint64_t hash = hash_combine(hash_combine(face[0], face[1]), face[2]);
        uint32_t& first = first_[hash & (first_.size() - 1)];
        for (uint32_t at = first; at != kNone; at = next_[at]) {
            if (faces_[at] == face) return false;
        }
        next_.push_back(std::exchange(first, static_cast<uint32_t>(faces_.size())));
        faces_.push_back(face);
        return true;
    }

  private:
    std::vector<uint32_t> first_, next_;
    std::vector<Corners> faces_;
};

Faces collect_faces(const SurfaceMesh& mesh, const std::vector<uint32_t>& place_of, MeshReport& report) {
    Faces faces;
    FaceSet seen(mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        Corners c;
        for (size_t k = 0; k < 3; ++k)
            c[k] = place_of[mesh.triangles[t][k]];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
            ++report.collapsed_faces;
            continue;
        }
        Corners key = c;
        std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
        if (!seen.insert(key)) {
            ++report.duplicate_faces;
            continue;
        }
        const glm::dvec3 a(mesh.positions[mesh.triangles[t][0]]);
        const glm::dvec3 across = glm::cross(glm::dvec3(mesh.positions[mesh.triangles[t][1]]) - a,
                                             glm::dvec3(mesh.positions[mesh.triangles[t][2]]) - a);
        const double length = glm::length(across);
        report.zero_area_faces += length > 0.0 ? 0u : 1u;
        faces.places.push_back(c);
        faces.source.push_back(t);
        faces.normal.push_back(length > 0.0 ? across / length : glm::dvec3(0.0));
    }
    return faces;
}

/// Gives corners their leaves: one for each place and sheet around it.
std::vector<uint32_t> number_leaves(const std::vector<uint32_t>& mates) {
    UnionFind fans(mates.size());
    for (uint32_t corner = 0; corner < mates.size(); ++corner) {
        if (mates[corner] == kNone) continue;
        fans.join(corner, next_corner(mates[corner]));
        fans.join(next_corner(corner), mates[corner]);
    }
    std::vector<uint32_t> leaf_of(mates.size()), name(mates.size(), kNone);
    uint32_t leaves = 0;
    for (uint32_t corner = 0; corner < leaf_of.size(); ++corner) {
        uint32_t& leaf = name[fans.find(corner)];
        if (leaf == kNone) leaf = leaves++;
        leaf_of[corner] = leaf;
    }
    return leaf_of;
}

/// Frees the sides of a triangle and locks its places.
void cut_out(uint32_t face, const Faces& faces, Sheets& sheets) {
    for (uint32_t corner = 3 * face; corner < 3 * face + 3; ++corner) {
        uint32_t& mate = sheets.mates[corner];
        if (mate != kNone) sheets.mates[mate] = kNone;
        mate = kNone;
        sheets.is_place_locked[faces.places[face][corner % 3]] = 1;
    }
}

/// Where the corners of each leaf would begin in a list sorted by leaf; its length behind.
std::vector<uint32_t> begins_of(const std::vector<uint32_t>& leaf_of) {
    std::vector<uint32_t> begin(2 + *std::max_element(leaf_of.begin(), leaf_of.end()), 0);
    for (uint32_t leaf : leaf_of)
        ++begin[leaf + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    return begin;
}

/// Numbers the leaves; where a sheet meets itself along an edge, so that the same two leaves would share two edges,
/// triangles are cut out until none do.
std::vector<uint32_t> settle_leaves(const Faces& faces, Sheets& sheets) {
    for (;;) {
        std::vector<uint32_t> leaf_of = number_leaves(sheets.mates);
        const std::vector<uint32_t> begin = begins_of(leaf_of);
        std::vector<uint32_t> next(begin), leads_to(leaf_of.size());  // by the leaf that a side leaves
        bool is_settled = true;
        for (uint32_t corner = 0; corner < leaf_of.size(); ++corner) {
            const uint32_t from = leaf_of[corner], to = leaf_of[next_corner(corner)];
            const auto known = leads_to.begin() + begin[from], end = leads_to.begin() + next[from];
            if (std::find(known, end, to) != end) {
                cut_out(corner / 3, faces, sheets);
                is_settled = false;
            }
            leads_to[next[from]++] = to;
        }
        if (is_settled) return leaf_of;
    }
}

void count_sheets(const Faces& faces, const Sheets& sheets, std::span<const uint32_t> leaf_of,
                  MeshReport& report) {
    std::vector<uint8_t> is_seen(leaf_of.size(), 0);
    std::vector<uint32_t> sheets_at(sheets.is_place_locked.size(), 0);
    UnionFind parts(faces.places.size());
    for (uint32_t corner = 0; corner < leaf_of.size(); ++corner) {
        if (!std::exchange(is_seen[leaf_of[corner]], uint8_t{1}))
            ++sheets_at[faces.places[corner / 3][corner % 3]];
        if (sheets.mates[corner] != kNone) parts.join(corner / 3, sheets.mates[corner] / 3);
    }
    for (uint32_t count : sheets_at)
        report.non_manifold_vertices += count > 1 ? 1u : 0u;
    for (uint32_t face = 0; face < faces.places.size(); ++face)
        report.components += parts.find(face) == face ? 1u : 0u;
}

/// What makes two corners of a leaf one drawn vertex.
struct Look {
    uint32_t leaf;
    glm::vec3 normal;
    glm::u8vec4 colour;
};

/// Fills the drawn vertices: the first look of a leaf is its own, all others follow behind the leaves.
void number_vertices(const SurfaceMesh& mesh, const Faces& faces, ManifoldMesh& out) {
    const size_t leaves = out.positions.size();
    std::vector<uint32_t> first(leaves, kNone), next;  // looks of a leaf as a list
    std::vector<Look> looks;
    std::vector<uint32_t> vertex_of_look;
    out.vertex_leaf.resize(leaves);
    out.normals.resize(leaves);
    out.colours.resize(leaves);
    for (size_t t = 0; t < faces.places.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t source = mesh.triangles[faces.source[t]][k];
            const Look look{out.triangles[t][k], mesh.normals[source], mesh.colours[source]};
            uint32_t at = first[look.leaf];
            while (at != kNone && !(looks[at].normal == look.normal && looks[at].colour == look.colour))
                at = next[at];
            if (at == kNone) {
                at = static_cast<uint32_t>(looks.size());
                const bool is_own = first[look.leaf] == kNone;
                const size_t vertex = is_own ? look.leaf : out.vertex_leaf.size();
                if (!is_own) {
                    out.vertex_leaf.emplace_back();
                    out.normals.emplace_back();
                    out.colours.emplace_back();
                }
                out.vertex_leaf[vertex] = look.leaf;
                out.normals[vertex] = look.normal;
                out.colours[vertex] = look.colour;
                looks.push_back(look);
                next.push_back(first[look.leaf]);
                vertex_of_look.push_back(static_cast<uint32_t>(vertex));
                first[look.leaf] = at;
            }
            out.triangle_corners[t][k] = vertex_of_look[at];
        }
    }
}

void count_seams(const ManifoldMesh& out, const std::vector<uint32_t>& mates, MeshReport& report) {
    const auto vertex = [&out](uint32_t corner) { return out.triangle_corners[corner / 3][corner % 3]; };
    for (uint32_t corner = 0; corner < mates.size(); ++corner) {
        const uint32_t mate = mates[corner];
        if (mate == kNone || mate < corner) continue;
        const bool is_smooth =
            vertex(corner) == vertex(next_corner(mate)) && vertex(next_corner(corner)) == vertex(mate);
        report.seam_edges += is_smooth ? 0u : 1u;
    }
}

}  // namespace

Result<ManifoldMesh> make_manifold(const SurfaceMesh& mesh, double weld_m, MeshReport& report) {
    if (Result<Ok> checked = check_input(mesh); !checked) return checked.error();
    report.vertices_in = static_cast<uint32_t>(mesh.positions.size());
    report.triangles_in = static_cast<uint32_t>(mesh.triangles.size());
    const std::vector<uint32_t> place_of = number_places(mesh.positions, weld_m);
    const uint32_t places = place_of.empty() ? 0 : 1 + *std::max_element(place_of.begin(), place_of.end());
    std::vector<glm::vec3> place_positions(places);
    for (size_t i = place_of.size(); i-- > 0;)
        place_positions[place_of[i]] = mesh.positions[i];
    report.places = places;
    const Faces faces = collect_faces(mesh, place_of, report);
    if (faces.places.empty()) return Error{"no triangle with three different corners; expected at least one"};
    Sheets sheets = join_sheets(faces, places, report);
    const std::vector<uint32_t> leaf_of = settle_leaves(faces, sheets);
    count_sheets(faces, sheets, leaf_of, report);

    ManifoldMesh out;
    const uint32_t leaves = 1 + *std::max_element(leaf_of.begin(), leaf_of.end());
    out.positions.resize(leaves);
    out.is_locked.resize(leaves, 0);
    out.triangles.resize(faces.places.size());
    out.triangle_corners.resize(faces.places.size());
    for (uint32_t corner = 0; corner < leaf_of.size(); ++corner) {
        const uint32_t leaf = leaf_of[corner], place = faces.places[corner / 3][corner % 3];
        out.triangles[corner / 3][corner % 3] = leaf;
        out.positions[leaf] = place_positions[place];
        out.is_locked[leaf] = sheets.is_place_locked[place];
    }
    for (uint8_t is_locked : out.is_locked)
        report.locked_leaves += is_locked;
    number_vertices(mesh, faces, out);
    count_seams(out, sheets.mates, report);
    return out;
}

}  // namespace lod
