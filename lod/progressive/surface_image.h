// SurfaceImage: where the full mesh lies on the mesh that its collapses leave, as a proof of how far the two are apart.
//
// A continuous map takes the full surface onto the coarse one. It is known by little:
//   - the triangle on which each full vertex lies; of a border vertex, the border edge;
//   - for each full edge the word of coarse edges that its image crosses (edge_words.h);
//   - for each coarse node the full triangle whose image holds it, its owner; at borders, the full border edges that
//     pass it.
// The image of a full triangle f is bounded by the words of its three edges and can be drawn together without crossing
// any node but those that f owns. Cut it along the coarse edges: every piece lies in one coarse triangle t, and its
// corners are full vertices of f on t, crossings of an edge of f with one of t, or nodes of t that f owns. At a corner
// a point x of f is paired with a point y of t: the vertex with its nearest point of t, the two edges' nearest points,
// the node and its nearest point of f. Between corners both are interpolated, so |x - y| is at most the largest at a
// corner. All x cover the full surface and all y the coarse one, because the maps are of degree one. Hence the largest
// distance at any corner bounds both directions of the Hausdorff distance, and what concerns t bounds it for t.
//
// No statement depends on a numeric decision: a bad choice of triangle, word or owner makes the bound loose, not wrong.
// A collapse (c, o) -> p changes the map inside the star only: c becomes p, o is forgotten. Letters through (o, r) of a
// removed triangle (c, o, r) vanish, those through (c, o) go round o's remaining triangles, all others stay. Then
// vertices move to the new triangle that is nearest, which adds letters round p to their edges' words; and p goes to a
// nearer owner, which sends the edge between round the other side. As this uses nothing but the star, the map on a
// triangle is the same in every front that has the triangle.
//
// Sources: Cohen, Manocha, Olano, Simplifying polygonal models using successive mappings (1997), for the bound at the
// corners of an overlay. Differs from it in: no projection; the overlay is known by homotopy alone.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lod/progressive/coarse_mesh.h"
#include "lod/progressive/collapse_step.h"
#include "lod/progressive/edge_words.h"
#include "lod/progressive/star_measures.h"
#include "lod/progressive/vertex_hierarchy.h"
#include "lod/surface/triangle.h"

namespace lod {

class SurfaceImage {
  public:
    /// The image of the full mesh on itself.
    /// @param leaves     places, mesh frame
    /// @param triangles  of leaves; a manifold. Kept by reference, must not change
    SurfaceImage(std::span<const glm::vec3> leaves, std::span<const std::array<NodeId, 3>> triangles);

    /// Takes the next collapse; its node's number is that of the leaves and all nodes before. No search goes on below what
    /// its triangles' error is no less than anyway, as far as vertices and owners say.
    /// @param out  what is to be measured to bound the triangles it makes is appended
    void collapse(const CollapseStep& step, StarMeasures& out);

    /// Calls up the memory that a collapse will read first; that of the next one is on its way while this one is taken.
    /// Changes nothing.
    void expect(const CollapseStep& step) const;

    /// Whether all full triangles can be drawn together as claimed. For tests; O(n).
    bool is_sound();

  private:
    static constexpr uint32_t kNone = 0xffffffffu;

    /// A node passed along a border, forwards or backwards.
    struct Pass {
        NodeId node = 0;
        bool is_forward = true;
        bool operator==(const Pass&) const = default;
    };
    /// A full edge; u to v has its left triangle on the left. Border edges have no other.
    struct alignas(64) FullEdge {
        uint32_t u = 0, v = 0;
        CornerId left = 0, right = kNoCorner;  ///< of the full mesh; no right: a border
        Word word;                             ///< crossed edges, from u to v
    };
    using Passes = std::vector<Pass>;
    /// A vertex in the star that is being replaced.
    struct Member {
        uint32_t vertex = 0;
        uint32_t from = 0, to = 0;  ///< sectors of the new fan
        bool is_ccw = true;
        bool passes_p = false;   ///< a border vertex that goes past p
        bool is_forward = true;  ///< … in the direction of the border
    };

    /// A new triangle, and when a vertex is clearly above its inside.
    struct Sector {
        Triangle triangle;
        std::array<glm::dvec3, 3> inward{};  ///< square to the sides, in its plane
        glm::dvec3 normal{0.0};              ///< unit length
        bool is_thin = true;                 ///< too thin for a normal

        explicit Sector(const Triangle& of);
        /// Whether the nearest point is inside of it and no farther than `limit_m`. Never true when it is farther.
        bool is_below(const glm::dvec3& place, double limit_m) const;
    };

    void begin_edges();
    void begin_vertices();
    void begin_words();
    void begin_owner(const Fan& fan, NodeId leaf);

    void choose_centre(const CollapseStep& step);
    void gather_star(const CollapseStep& step);
    void touch_crossers(CornerId corner);
    void touch(uint32_t edge);
    void plan_removed(uint32_t triangle);
    void plan_contracted();
    void carry_members();
    void replace_star(const CollapseStep& step);
    void move_members();
    bool is_unnoticed(Member& member, const glm::dvec3& at, double unnoticed_m) const;
    void move_inner(Member& member, const glm::dvec3& at);
    void move_border(Member& member, const glm::dvec3& at);
    void rewrite(uint32_t edge);
    void touch_moved();
    void suspect(const FullEdge& edge);
    void untwist();
    int excess_turns(uint32_t vertex, bool is_ccw) const;
    void turn_vertex(uint32_t vertex, bool is_ccw);
    void rewrite_passes(uint32_t edge, const Member* u, const Member* v);
    void find_owner();
    bool find_way(uint32_t from, double apart);
    bool flip(uint32_t edge, uint32_t from, uint32_t to);
    bool send_round(FullEdge& edge, bool is_ccw);
    void file_crossers();
    void note_measures(const CollapseStep& step, StarMeasures& out) const;
    void note_crossings(CornerId spoke, StarMeasures& out) const;
    double owner_distance(NodeId node, uint32_t triangle) const;

    CornerId canonical(CornerId corner) const;
    const glm::dvec3& at(NodeId node) const { return positions_[node]; }
    Triangle coarse_triangle(CornerId corner) const;
    bool can_fill(uint32_t triangle);

    std::span<const std::array<NodeId, 3>> triangles_;
    uint32_t leaf_count_ = 0;
    std::vector<glm::dvec3> positions_;  // [nodes so far]
    CoarseMesh mesh_;
    std::vector<FullEdge> edges_;
    std::vector<uint32_t> edge_of_;           // [corners of the full mesh]
    std::vector<uint32_t> incident_begin_;    // [leaves + 1] into incident_
    std::vector<uint32_t> incident_;          // full edges at a vertex
    std::vector<ShortList<uint32_t, 6>> on_;  // [triangles] full vertices that lie there
    std::vector<uint32_t> triangle_of_;       // [leaves] where the full vertex lies
    std::vector<CornerId> border_of_;         // [leaves] its border half-edge; kNoCorner: inside
    std::vector<ShortList<uint32_t, 6>>
        crossers_;  // [corners, the canonical] full edges that cross, perhaps twice
    std::unordered_map<uint32_t, Passes> passes_;  // of border edges: nodes passed
    std::vector<std::vector<uint32_t>> passers_;   // [nodes] full border edges that pass
    std::vector<uint32_t> owner_;                  // [nodes] full triangle; kNone at borders
    std::vector<ShortList<NodeId, 2>> owned_;      // [triangles of the full mesh]
    std::vector<CornerId> corner_of_;              // [nodes] one of its corners
    std::vector<double> owner_m_;                  // [nodes] distance from the owner; 0 at borders
    std::vector<double> seen_m_;                   // [nodes] their errors are no less

    // The collapse at hand.
    NodeId p_ = 0, centre_ = 0, other_ = 0;
    Fan fan_;
    std::vector<Sector> sectors_;  // of the fan: the new triangles
    std::vector<uint32_t> star_;   // old triangles
    std::vector<Member> members_;
    std::vector<CornerId> start_;    // [members] corner of the triangle where each is at first
    std::vector<uint32_t> touched_;  // full edges to rewrite
    struct Step {
        uint32_t triangle = 0, before = 0, edge = 0;  ///< reached from step `before` across a full edge
        double apart = 0.0;
    };
    std::vector<Step> way_;  // full triangles looked at on the way to a nearer owner
    Word scratch_, before_;
    Loop loop_;
    Filling filling_;
    std::vector<std::pair<uint32_t, bool>> suspects_;  // vertices with an edge that goes round p, is_ccw
    std::vector<uint32_t> member_of_;                  // [leaves] into members_, kNone: outside
    std::vector<uint8_t> is_touched_;                  // [edges]
    std::vector<uint32_t> sector_of_;                  // [triangles] in the new fan
    std::vector<uint32_t> rule_of_;                    // [corners] into rules_, kNone: stays
    std::vector<Word> rules_;
    std::vector<CornerId> ruled_;
    struct Removed {
        uint32_t triangle = 0;
        CornerId contracted = 0, side_c = 0, side_o = 0;  ///< half-edges: c o, c r, o r
        CornerId beyond_c = 0, beyond_o = 0;              ///< their mates
    };
    std::vector<Removed> removed_;
    double noise_m_ = 0.0;   // of the coordinates
    double enough_m_ = 0.0;  // the error at hand is no less: below this nothing is worth a search
    double bound2_ = 0.0;    // largest squared distance of a vertex
};

}  // namespace lod
