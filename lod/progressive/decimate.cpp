#include "lod/progressive/decimate.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "lod/base/indexed_heap.h"
#include "lod/progressive/coarse_mesh.h"
#include "lod/progressive/hierarchy_recorder.h"
#include "lod/progressive/quadric.h"
#include "lod/progressive/star_safety.h"

namespace lod {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Vertex = HalfEdges::VertexHandle;
using HalfEdge = HalfEdges::HalfedgeHandle;
using Edge = HalfEdges::EdgeHandle;
using Face = HalfEdges::FaceHandle;

uint32_t index(OpenMesh::BaseHandle handle) {
    return static_cast<uint32_t>(handle.idx());
}

/// What settles the order of collapses, ties included.
struct Urgency {
    double cost = 0.0;
    double length2 = 0.0;
    uint32_t edge = 0;
    bool operator<(const Urgency& o) const {
        return std::tie(cost, length2, edge) < std::tie(o.cost, o.length2, o.edge);
    }
};

/// Where an edge would go, and what that costs.
struct Target {
    glm::vec3 position{0.0f};
    double cost = 0.0;
};

class Decimator {
  public:
    Decimator(const ManifoldMesh& mesh, const DecimateOptions& options);
    VertexHierarchy run(const std::function<void(const CollapseStep&)>& follow);

  private:
    void add_faces();
    void add_quadrics();
    void hold_edge(HalfEdge side);
    void offer(Edge edge);
    void offer_again(Vertex vertex);
    bool consider(Edge edge);
    void collapse(Edge edge, const glm::vec3& position);
    std::optional<Target> best_target(Edge edge) const;
    std::optional<Target> fallback_target(Edge edge, bool only_safe) const;
    Quadric quadric_of(Edge edge) const;
    double cost_at(const Quadric& quadric, const glm::vec3& position) const;
    bool is_held(Vertex vertex) const { return is_locked_[index(vertex)] != 0; }
    bool is_safe(Edge edge, const glm::vec3& position) const;
    bool are_turns_safe(Vertex moved, Vertex other, const glm::vec3& to) const;
    glm::dvec3 local(const glm::vec3& p) const { return (glm::dvec3(p) - middle_) * scale_; }
    glm::vec3 in_mesh(const glm::dvec3& p) const { return glm::vec3(p / scale_ + middle_); }
    std::array<Vertex, 2> ends(Edge edge) const {
        const HalfEdge side = half_edges_.halfedge_handle(edge, 0);
        return {half_edges_.to_vertex_handle(side), half_edges_.from_vertex_handle(side)};
    }

    const ManifoldMesh& mesh_;
    const DecimateOptions& options_;
    HalfEdges half_edges_;
    HierarchyRecorder recorder_;
    glm::dvec3 middle_{0.0};
    double scale_ = 1.0;
    std::vector<glm::vec3> positions_;  // [half-edge vertices], mesh frame
    std::vector<uint8_t> is_locked_;
    std::vector<NodeId> node_;
    std::vector<Quadric> quadrics_;
    std::vector<glm::vec3> full_normals_;  // [triangles]; zero: no area
    IndexedHeap<Urgency> heap_{0};
    std::vector<glm::vec3> targets_;      // [edges]
    std::vector<uint8_t> is_waiting_;     // [edges] was not safe when its turn came
    std::vector<uint8_t> is_second_try_;  // [edges] its target is a fallback
    std::vector<uint32_t> around_[2];     // scratch
    std::vector<Edge> old_edges_;         // scratch
};

Decimator::Decimator(const ManifoldMesh& mesh, const DecimateOptions& options)
    : mesh_(mesh),
      options_(options),
      recorder_(mesh),
      positions_(mesh.positions),
      is_locked_(mesh.is_locked) {
    glm::dvec3 low(positions_[0]), high = low;
    for (const glm::vec3& p : positions_) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    middle_ = 0.5 * (low + high);
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    scale_ = extent > 0.0 ? 1.0 / extent : 1.0;
    for (uint32_t leaf = 0; leaf < positions_.size(); ++leaf)
        node_.push_back(leaf);
    add_faces();
    add_quadrics();
    heap_ = IndexedHeap<Urgency>(static_cast<uint32_t>(half_edges_.n_edges()));
    targets_.resize(half_edges_.n_edges());
    is_waiting_.resize(half_edges_.n_edges(), 0);
    is_second_try_.resize(half_edges_.n_edges(), 0);
}

/// The mesh is a manifold and its mates are known: links are set as they are, without a search for each face's place.
void Decimator::add_faces() {
    const auto leaves = static_cast<uint32_t>(positions_.size());
    const CoarseMesh corners(mesh_.triangles, leaves);
    half_edges_.reserve(leaves, 2 * mesh_.triangles.size(), mesh_.triangles.size());
    for (uint32_t leaf = 0; leaf < leaves; ++leaf)
        half_edges_.add_vertex(HalfEdges::Point(0.0f, 0.0f, 0.0f));
    const auto vertex = [](NodeId leaf) { return Vertex(static_cast<int>(leaf)); };
    std::vector<HalfEdge> side(corners.corner_count());  // that leaves each corner
    for (CornerId corner = 0; corner < side.size(); ++corner) {
        const CornerId mate = corners.mate(corner);
        side[corner] = mate < corner
                           ? half_edges_.opposite_halfedge_handle(side[mate])
                           : half_edges_.new_edge(vertex(corners.node(corner)), vertex(corners.head(corner)));
    }
    for (CornerId first = 0; first < side.size(); first += 3) {
        const Face face = half_edges_.new_face();
        half_edges_.set_halfedge_handle(face, side[first]);
        for (CornerId corner = first; corner < first + 3; ++corner) {
            half_edges_.set_face_handle(side[corner], face);
            half_edges_.set_next_halfedge_handle(side[corner], side[next_corner(corner)]);
            half_edges_.set_halfedge_handle(vertex(corners.node(corner)), side[corner]);
        }
    }
    Fan fan;
    for (CornerId corner = 0; corner < side.size(); ++corner) {
        if (corners.mate(corner) != kNoCorner) continue;
        corners.fan_at(corner, fan);  // from this border to the one that arrives
        const HalfEdge in = half_edges_.opposite_halfedge_handle(side[corner]);
        const HalfEdge out = half_edges_.opposite_halfedge_handle(side[prev_corner(fan.corners.back())]);
        half_edges_.set_next_halfedge_handle(in, out);
        half_edges_.set_halfedge_handle(vertex(corners.node(corner)), out);
    }
}

/// A plane through a border or a break of colour, square to the triangle at that side.
void Decimator::hold_edge(HalfEdge side) {
    const Vertex from = half_edges_.from_vertex_handle(side), to = half_edges_.to_vertex_handle(side);
    const Vertex third = half_edges_.to_vertex_handle(half_edges_.next_halfedge_handle(side));
    const glm::dvec3 a = local(positions_[index(from)]), b = local(positions_[index(to)]);
    const glm::dvec3 along = b - a;
    const glm::dvec3 up = glm::cross(along, local(positions_[index(third)]) - a);
    const glm::dvec3 across = glm::cross(along, up);
    const double length = glm::length(across);
    if (!(length > 0.0)) return;
    const glm::dvec3 normal = across / length;
    const Quadric plane =
        Quadric::of_plane(normal, glm::dot(normal, a), options_.border_weight * glm::dot(along, along));
    quadrics_[index(from)] += plane;
    quadrics_[index(to)] += plane;
}

void Decimator::add_quadrics() {
    quadrics_.resize(positions_.size());
    for (const auto& triangle : mesh_.triangles) {
        const glm::dvec3 a = local(positions_[triangle[0]]);
        const glm::dvec3 across =
            glm::cross(local(positions_[triangle[1]]) - a, local(positions_[triangle[2]]) - a);
        const double length = glm::length(across);
        const glm::dvec3 normal = length > 0.0 ? across / length : glm::dvec3(0.0);
        full_normals_.emplace_back(normal);
        const Quadric plane = Quadric::of_plane(normal, glm::dot(normal, a), 0.5 * length);
        for (uint32_t leaf : triangle)
            quadrics_[leaf] += plane;
    }
    const auto colour_at = [this](HalfEdge side) {
        const auto face = index(half_edges_.face_handle(side));
        const Vertex to = half_edges_.to_vertex_handle(side);
        for (size_t k = 0; k < 3; ++k) {
            if (mesh_.triangles[face][k] == index(to)) return mesh_.colours[mesh_.triangle_corners[face][k]];
        }
        return glm::u8vec4(0);
    };
    for (const Edge edge : half_edges_.edges()) {
        const HalfEdge one = half_edges_.halfedge_handle(edge, 0),
                       other = half_edges_.halfedge_handle(edge, 1);
        if (half_edges_.is_boundary(edge)) {
            hold_edge(half_edges_.is_boundary(one) ? other : one);
        } else if (colour_at(one) != colour_at(half_edges_.prev_halfedge_handle(other)) ||
                   colour_at(other) != colour_at(half_edges_.prev_halfedge_handle(one))) {
            hold_edge(one);
            hold_edge(other);
        }
    }
}

Quadric Decimator::quadric_of(Edge edge) const {
    const auto [a, b] = ends(edge);
    Quadric sum = quadrics_[index(a)];
    sum += quadrics_[index(b)];
    return sum;
}

double Decimator::cost_at(const Quadric& quadric, const glm::vec3& position) const {
    constexpr double kNoise = 1e-14;  // squared, of the extent: what float coordinates leave of a plane
    const double cost = quadric.at(local(position));
    return cost > kNoise * quadric.weight ? cost : 0.0;
}

/// The best of both ends and, if it may be off them, the middle, as far as they may move.
std::optional<Target> Decimator::fallback_target(Edge edge, bool only_safe) const {
    const auto [a, b] = ends(edge);
    const glm::vec3 &at_a = positions_[index(a)], &at_b = positions_[index(b)];
    const bool is_border_edge = half_edges_.is_boundary(edge);
    const bool is_a_fixed = is_held(a) || (half_edges_.is_boundary(a) && !is_border_edge);
    const bool is_b_fixed = is_held(b) || (half_edges_.is_boundary(b) && !is_border_edge);
    std::optional<Target> best;
    const Quadric quadric = quadric_of(edge);
    const auto attempt = [&](const glm::vec3& position) {
        if (only_safe && !is_safe(edge, position)) return;
        const double cost = cost_at(quadric, position);
        if (!best || cost < best->cost) best = Target{position, cost};
    };
    if (is_a_fixed && is_b_fixed) return best;
    if (!is_b_fixed) attempt(at_a);
    if (!is_a_fixed) attempt(at_b);
    if (!is_a_fixed && !is_b_fixed && options_.place == CollapsePlace::kBest)
        attempt(glm::vec3(0.5 * (glm::dvec3(at_a) + glm::dvec3(at_b))));
    return best;
}

std::optional<Target> Decimator::best_target(Edge edge) const {
    const auto [a, b] = ends(edge);
    const bool is_free =
        !is_held(a) && !is_held(b) && half_edges_.is_boundary(a) == half_edges_.is_boundary(b);
    if (options_.place == CollapsePlace::kEnd) return fallback_target(edge, false);
    if (options_.metric == CollapseMetric::kEdgeLength && is_free) {
        const glm::dvec3 middle = 0.5 * (glm::dvec3(positions_[index(a)]) + glm::dvec3(positions_[index(b)]));
        return Target{glm::vec3(middle), 0.0};
    }
    std::optional<Target> best = fallback_target(edge, false);
    if (!best || !is_free || best->cost == 0.0) return best;
    const Quadric quadric = quadric_of(edge);
    const std::optional<glm::dvec3> least = quadric.least();
    if (!least) return best;
    const glm::dvec3 at_a = local(positions_[index(a)]), at_b = local(positions_[index(b)]);
    const glm::dvec3 off = *least - 0.5 * (at_a + at_b), along = at_b - at_a;
    if (glm::dot(off, off) > 4.0 * glm::dot(along, along)) return best;
    const glm::vec3 position = in_mesh(*least);
    const double cost = cost_at(quadric, position);
    if (cost < best->cost) best = Target{position, cost};
    return best;
}

/// Puts an edge into the heap, or takes it out when it must stay.
void Decimator::offer(Edge edge) {
    is_waiting_[index(edge)] = is_second_try_[index(edge)] = 0;
    const std::optional<Target> target = best_target(edge);
    if (!target) return heap_.erase(index(edge));
    const auto [a, b] = ends(edge);
    const glm::dvec3 along = local(positions_[index(b)]) - local(positions_[index(a)]);
    const double length2 = glm::dot(along, along);
    const double cost = options_.metric == CollapseMetric::kQuadric ? target->cost : length2;
    targets_[index(edge)] = target->position;
    heap_.set(index(edge), {cost, length2, index(edge)});
}

/// Offers the edges around a vertex that were turned away.
void Decimator::offer_again(Vertex vertex) {
    for (auto it = half_edges_.cve_iter(vertex); it.is_valid(); ++it) {
        if (is_waiting_[index(*it)]) offer(*it);
    }
}

bool Decimator::are_turns_safe(Vertex moved, Vertex other, const glm::vec3& to) const {
    for (auto it = half_edges_.cvoh_iter(moved); it.is_valid(); ++it) {
        if (half_edges_.is_boundary(*it)) continue;
        const Vertex next = half_edges_.to_vertex_handle(*it);
        const Vertex last = half_edges_.to_vertex_handle(half_edges_.next_halfedge_handle(*it));
        if (next == other || last == other) continue;
        const Corner3 after{to, positions_[index(next)], positions_[index(last)]};
        const Corner3 before{positions_[index(moved)], after[1], after[2]};
        const glm::vec3& full_normal = full_normals_[index(half_edges_.face_handle(*it))];
        if (!is_change_safe(before, after, full_normal, {options_.max_turn_cos, options_.min_quality}))
            return false;
    }
    return true;
}

bool Decimator::is_safe(Edge edge, const glm::vec3& position) const {
    const auto [a, b] = ends(edge);
    return are_turns_safe(a, b, position) && are_turns_safe(b, a, position);
}

/// Whether the edge on top may collapse now; if not, it waits, or comes again with another target.
bool Decimator::consider(Edge edge) {
    HalfEdges& mesh = half_edges_;
    const bool is_linked = mesh.is_collapse_ok(mesh.halfedge_handle(edge, 0));
    if (is_linked && is_safe(edge, targets_[index(edge)])) return true;
    const Urgency urgency = heap_.key(index(edge));
    heap_.erase(index(edge));
    is_waiting_[index(edge)] = 1;
    if (!is_linked || is_second_try_[index(edge)]) return false;
    const std::optional<Target> other = fallback_target(edge, true);
    if (!other) return false;
    is_waiting_[index(edge)] = 0;
    is_second_try_[index(edge)] = 1;
    targets_[index(edge)] = other->position;
    const double cost = options_.metric == CollapseMetric::kQuadric ? other->cost : urgency.cost;
    heap_.set(index(edge), {std::max(cost, urgency.cost), urgency.length2, index(edge)});
    return false;
}

void Decimator::collapse(Edge edge, const glm::vec3& position) {
    const HalfEdge side = half_edges_.halfedge_handle(edge, 0);
    const auto [a, b] = ends(edge);
    old_edges_.clear();
    const std::array<Vertex, 2> both{a, b};
    for (size_t i = 0; i < 2; ++i) {
        around_[i].clear();
        for (auto it = half_edges_.cvf_iter(both[i]); it.is_valid(); ++it)
            around_[i].push_back(index(*it));
        for (auto it = half_edges_.cve_iter(both[i]); it.is_valid(); ++it)
            old_edges_.push_back(*it);
    }
    const glm::dvec3 at_a(positions_[index(a)]), along = glm::dvec3(positions_[index(b)]) - at_a;
    const double length2 = glm::dot(along, along);
    const double share = length2 > 0.0 ? glm::dot(glm::dvec3(position) - at_a, along) / length2 : 0.0;
    const NodeId node =
        recorder_.record({node_[index(a)], node_[index(b)], position,
                          static_cast<float>(std::clamp(share, 0.0, 1.0)), around_[0], around_[1]});
    half_edges_.collapse(side);
    node_[index(a)] = node;
    positions_[index(a)] = position;
    is_locked_[index(a)] = is_locked_[index(a)] | is_locked_[index(b)];
    quadrics_[index(a)] += quadrics_[index(b)];
    for (const Edge old : old_edges_) {
        if (half_edges_.status(old).deleted()) heap_.erase(index(old));
    }
    for (auto it = half_edges_.cve_iter(a); it.is_valid(); ++it)
        offer(*it);
    for (auto it = half_edges_.cvv_iter(a); it.is_valid(); ++it)
        offer_again(*it);
}

VertexHierarchy Decimator::run(const std::function<void(const CollapseStep&)>& follow) {
    for (const Edge edge : half_edges_.edges())
        offer(edge);
    while (!heap_.is_empty()) {
        const Edge edge(static_cast<int>(heap_.top()));
        if (!consider(edge)) continue;
        collapse(edge, targets_[index(edge)]);
        follow(recorder_.last_step());
    }
    return recorder_.finish();
}

}  // namespace

VertexHierarchy decimate(const ManifoldMesh& mesh, const DecimateOptions& options,
                         const std::function<void(const CollapseStep&)>& follow) {
    return Decimator(mesh, options).run(follow);
}

}  // namespace lod
