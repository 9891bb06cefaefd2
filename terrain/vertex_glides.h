// VertexGlides: vertices on their way between the edge they were born on and their own place.
//
// A split puts its new vertex on the edge it cuts and lets it glide to its place; a merge waits until
// its vertex has glided back. The way is a smooth function of time, whatever the frame rate. An edge's ends may be
// gliding themselves: the edge is taken where it is shown, so no frame breaks an edge.
//
//     shown = place + w (point of the edge between its ends' places - place + the ends' displacements there)
//     w: 1 -> 0 or back
//
// Source: seed paper 002, geomorphing; here in time, because a front at its budget has no view at which w is 0.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "terrain/diamond_mesh.h"

namespace terrain {

/// A place on the mesh as it is without a vertex: between the two ends of the edge it would cut or, where a border
/// clamps vertices off their edges, among three corners of a triangle. Unused ends have share 0.
struct GlideBase {
    std::array<DiamondIndex, 3> ends{};
    std::array<uint8_t, 3> levels{};  ///< of the ends
    std::array<float, 3> shares{};    ///< of the ends, summing to 1

    bool is_middle() const { return shares[2] == 0.0f; }
};

/// One vertex under way.
struct VertexGlide {
    DiamondIndex index = kOutside;
    GlideBase base;
    float from = 0.0f, to = 0.0f;  ///< w at the start and at the end
    double start_s = 0.0;
    float weight = 0.0f;                ///< w now
    glm::vec3 base_from_place_m{0.0f};  ///< the base where its ends' own places are, seen from the vertex's
    glm::vec3 shown_m{0.0f};            ///< displacement now
    glm::vec3 before_m{0.0f};           ///< … and in the frame before
    float error_px = 0.0f;  ///< of its diamond when not split, as the front measured it in this frame
    float way_px = 0.0f;    ///< that shown_m costs, likewise
};

class VertexGlides {
  public:
    /// @param duration_s  of a whole glide, > 0
    explicit VertexGlides(double duration_s) : duration_s_(duration_s) {}

    bool is_empty() const { return count_ == 0; }
    /// No vertex is farther from its place than this.
    float farthest_m() const { return farthest_m_; }
    size_t count() const { return count_; }
    std::span<const VertexGlide> at_level(int level) const { return levels_[static_cast<size_t>(level)]; }
    std::span<VertexGlide> at_level(int level) { return levels_[static_cast<size_t>(level)]; }

    /// A vertex that has just been born on its edge, or (`leaves`) begins to go back to it. One that is under way
    /// turns round where it is. Returns it, until the next call.
    const VertexGlide& start(const VertexGlide& glide, int level, bool leaves, double now_s);
    /// Turns one round that is under way; nothing when it is not.
    void turn_round(DiamondIndex index, int level, bool leaves, double now_s);
    /// One that is under way; null for any other.
    const VertexGlide* find(DiamondIndex index, int level) const;
    /// The vertex is gone.
    void drop(DiamondIndex index, int level);
    void clear();

    /// Moves all to where they are at `now_s`. Those that arrived are dropped; those back on their edge stay, and
    /// are listed in `back`. Cost: about 20 ns a glide.
    void advance(double now_s, std::vector<DiamondIndex>& back);

    /// After places have changed: all go on from where they are on their way, between their new places.
    /// @param place_m  a record's place, metres relative to the anchor
    template <typename PlaceOf>
    void rebase(double now_s, const PlaceOf& place_m) {
        farthest_m_ = 0.0f;
        for (std::vector<VertexGlide>& glides : levels_) {
            for (VertexGlide& glide : glides) {
                glide.base_from_place_m = -place_m(glide.index);
                for (size_t end = 0; end < 3; ++end) {
                    if (glide.base.shares[end] > 0.0f)
                        glide.base_from_place_m += glide.base.shares[end] * place_m(glide.base.ends[end]);
                }
                glide.weight = weight(glide, now_s);
                glide.shown_m = glide.before_m = glide.weight * shown_base_m(glide);
                farthest_m_ = std::max(farthest_m_, glm::length(glide.shown_m));
            }
        }
    }

    /// Displacement of a vertex from its place; zero for one that does not glide.
    glm::vec3 displacement_m(DiamondIndex index, int level) const;

  private:
    std::vector<VertexGlide>& level_of(int level) { return levels_[static_cast<size_t>(level)]; }
    float weight(const VertexGlide& glide, double now_s) const;
    void turn(VertexGlide& glide, bool leaves, double now_s) const;
    /// Where its base is shown, seen from the vertex's place.
    glm::vec3 shown_base_m(const VertexGlide& glide) const;

    double duration_s_;
    std::array<std::vector<VertexGlide>, kMostLevels>
        levels_;  ///< [level], by index: an edge's ends are coarser
    size_t count_ = 0;
    float farthest_m_ = 0.0f;
};

}  // namespace terrain
