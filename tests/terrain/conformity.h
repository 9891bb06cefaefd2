// Whether drawn triangles are conforming, under the names the terrain tests use.
#pragma once

#include "terrain/drawn/conformity.h"
#include "tests/terrain/drawn_mesh.h"

namespace terrain_test {

using terrain::drawn::area_of;
using terrain::drawn::conformity_fault;
using terrain::drawn::key_of;
using terrain::drawn::text;
using terrain::drawn::vertex_inside;
using terrain::drawn::without_skirts;

}  // namespace terrain_test
