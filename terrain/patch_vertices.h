// PatchVertices: slots for the samples that leaves drawn as patches need beside the mesh's own vertices.
//
// A sample has one slot however many leaves use it: those on a common edge find each other's by its place. A slot
// lives as long as an index names it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/diamond.h"

namespace terrain {

class PatchVertices {
  public:
    /// A sample, as the diamond it is the centre of.
    struct Place {
        int x = 0, y = 0;
        uint8_t level = 0;
        uint8_t uses =
            0;  ///< indices that name it, at most 8 triangles around it, twice while they are rewritten
        GridPoint centre() const { return {x, y}; }
    };

    /// Forgets everything; slots from `first` on, `capacity` of them.
    void reset(uint32_t first, uint32_t capacity);
    void clear();

    /// The slot of a sample; a new one is listed in made(). When there is none left, `first`, and is_overfull().
    uint32_t slot_of(GridPoint centre, int level);
    void hold(uint32_t slot);
    void release(std::span<const uint32_t> indices);
    /// Frees the new ones that nothing names after all.
    void sweep();
    /// Begins a new list of new ones.
    void begin() { made_.clear(); }

    bool is_overfull() const { return is_overfull_; }
    std::span<const uint32_t> made() const { return made_; }
    const Place& operator[](uint32_t slot) const { return places_[slot - first_]; }
    bool is_used(uint32_t slot) const { return places_[slot - first_].uses > 0; }
    uint32_t first() const { return first_; }
    /// Slots that were ever used.
    uint32_t end() const { return first_ + static_cast<uint32_t>(places_.size()); }
    uint32_t count() const { return static_cast<uint32_t>(places_.size() - free_.size()); }

  private:
    size_t cell_of(GridPoint centre) const;
    void forget(uint32_t slot);

    uint32_t first_ = 0, capacity_ = 0;
    std::vector<Place> places_;  ///< [slot - first]
    std::vector<uint32_t> free_, made_;
    std::vector<uint32_t> cells_;  ///< open addressing by place, linear
    bool is_overfull_ = false;
};

}  // namespace terrain
