// validate_mesh: proves that a set of split diamonds is a conforming mesh and that its links are whole.
#pragma once

#include <string>

#include "terrain/diamond_mesh.h"

namespace terrain {

/// Walks every record. Checks kinship both ways, that split diamonds have split parents (so no T-junction can
/// exist), the counts of split children, the number of leaf triangles and the hash.
/// @returns empty when all holds, else one line naming the first fault
/// Cost: O(records).
std::string validate_mesh(const DiamondMesh& mesh);

}  // namespace terrain
