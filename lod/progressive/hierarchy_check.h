// Is a vertex hierarchy what it claims to be? For what comes from files, and for tests.
#pragma once

#include <string>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// What is wrong first, as "what; expected what"; empty when the arrays agree in size, ids are in range, parents and
/// children name one another, the collapses replayed find their corners as they are written, numbers are finite, and
/// errors rise to the roots. Cost: O(n).
std::string fault_of(const VertexHierarchy& hierarchy);

}  // namespace lod
