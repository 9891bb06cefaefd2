// AliveTree: points of space and time of which the nearest that are still alive are asked for, until none is.
//
// A k-d tree over five coordinates (three of place, two of time), scaled so that distances of 1 count alike. Every
// node knows whether anything below it is alive.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace objects {

using PlaceAndTime = std::array<double, 5>;

class AliveTree {
  public:
    /// All points are alive. Cost: O(n log n).
    explicit AliveTree(std::span<const PlaceAndTime> points);

    /// No longer found. CHECKs that it was alive.
    void remove(uint32_t point);
    bool is_alive(uint32_t point) const { return is_alive_[place_[point]] != 0; }

    /// The up to `most` living points nearest to `point` (itself left out) within `radius`, nearest first; of equal
    /// distances the smaller index. `out` is cleared first.
    /// @returns  how many nodes of the tree were looked at
    size_t nearest(uint32_t point, double radius, size_t most, std::vector<uint32_t>& out) const;

  private:
    struct Node {
        PlaceAndTime low, high;
        uint32_t begin = 0, end = 0;
        uint32_t right = 0;  ///< second child, the first follows at once; 0: a leaf
        uint32_t alive = 0;
    };
    uint32_t split(std::span<const PlaceAndTime> points, uint32_t begin, uint32_t end);

    std::vector<Node> nodes_;
    std::vector<PlaceAndTime> points_;  ///< in the order of the leaves
    std::vector<uint32_t> original_;    ///< [points_]
    std::vector<uint32_t> place_;       ///< [original] where it lies
    std::vector<uint8_t> is_alive_;     ///< [points_]
};

}  // namespace objects
