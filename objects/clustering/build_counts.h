// What a build of a cluster tree did, in counts: the same on every machine, for any number of threads.
//
// Times tell how fast a machine is; these tell whether the work grows with the scene or faster
// (tests/objects/cluster_scaling_test.cpp).
#pragma once

#include <cstdint>

namespace objects {

struct BuildCounts {
    uint64_t nodes = 0;  ///< of trees over place and time, looked at in search of neighbours
    uint64_t steps = 0;  ///< of visibilities that were compared or averaged
    uint64_t faces = 0;  ///< that were joined to be reduced

    void add(const BuildCounts& other) {
        nodes += other.nodes;
        steps += other.steps;
        faces += other.faces;
    }
};

}  // namespace objects
