// BlockSimplifier: collapses the full mesh of one block, cheapest vertex first, and keeps the sequence.
//
// A collapse puts a neighbour in a vertex's place. Its cost is the true error of the triangles it leaves: the
// greatest distance to any sample they cover, not an estimate. Vertices on the border move along it only, and go
// by powers of two (first the odd ones), so that two blocks which share a side agree on its vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/rivals/border_fan.h"
#include "terrain/rivals/progressive_block.h"

namespace terrain {

class BlockSimplifier {
  public:
    BlockSimplifier(const data::HeightGrid& grid, GridPoint origin, GridPoint size);

    /// Collapses everything that can be collapsed.
    void run();
    /// The sequence, read backwards.
    ProgressiveBlock result() const;

  private:
    static constexpr uint16_t kNoTarget = 0xffff;
    struct Candidate {
        float cost_m;
        uint16_t vertex;
        bool operator>(const Candidate& other) const {
            return cost_m > other.cost_m || (cost_m == other.cost_m && vertex > other.vertex);
        }
    };
    struct Vertex {
        std::vector<uint16_t> star;  ///< triangles around it
        uint16_t target = kNoTarget;
        bool is_stale = false;  ///< its star has changed since it was ranked
        bool is_queued = false;
        bool is_gone = false;
    };
    struct Triangle {
        std::array<uint16_t, 3> corners;
        float error_m = 0.0f;
        float fan_error_m = -1.0f;  ///< with the worst fans; negative: not measured yet
        bool is_gone = false;
    };
    struct Collapse {
        uint16_t vertex, target;
        uint16_t fixed = 0;
    };

    /// [old] new numbers.
    struct Numbers {
        std::vector<uint16_t> vertex, triangle;
    };

    GridPoint place(uint16_t vertex) const { return {vertex % (size_.x + 1), vertex / (size_.x + 1)}; }
    CellTriangle cell_triangle(const std::array<uint16_t, 3>& corners) const {
        return {place(corners[0]), place(corners[1]), place(corners[2])};
    }
    float error_m(const CellTriangle& t) const;
    float fan_error_m(const CellTriangle& t) const;
    int side_of(uint16_t vertex) const;
    bool is_allowed(uint16_t vertex, int side) const;
    float collapse_cost_m(uint16_t vertex, uint16_t target, float limit_m) const;
    float rank(uint16_t vertex);
    void enqueue(uint16_t vertex, float cost_m);
    void collapse(uint16_t vertex, uint16_t target, float cost_m);
    void leave_side(uint16_t vertex, float cost_m);
    void add_stop();
    Numbers renumber() const;

    const data::HeightGrid& grid_;
    GridPoint origin_, size_;
    std::vector<Vertex> vertices_;  ///< [row * (size.x + 1) + column]
    std::vector<Triangle> triangles_;
    std::vector<Candidate> queue_;  ///< a heap, cheapest first
    std::vector<Collapse> collapses_;
    std::vector<uint16_t> fixed_, removed_;      ///< triangles, collapse after collapse
    std::vector<ProgressiveBlock::Stop> stops_;  ///< finest first; their counts are those of collapses
    uint32_t active_triangles_ = 0;
    std::array<std::array<uint8_t, kBareShift>, 4>
        on_side_{};                     ///< [side][shift] vertices left whose position is odd
                                        ///< multiples of 1 << shift
    std::vector<uint16_t> neighbours_;  ///< scratch
};

}  // namespace terrain
