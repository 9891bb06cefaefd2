// The triangles that are drawn, under the names the terrain tests use.
#pragma once

#include "terrain/drawn/drawn_mesh.h"

namespace terrain_test {

using terrain::drawn_triangles;
using terrain::DrawnTriangle;
using terrain::emit_triangles;
using terrain::PoolTwin;

}  // namespace terrain_test
