// GLB writer: a polygon mesh as one binary glTF 2.0 file.
#pragma once

#include <string>
#include <vector>

#include "data/polygon_mesh.h"
#include "lod/base/result.h"

namespace data {

/// The mesh as the bytes of a GLB: nodes, transforms and names kept, one primitive per node and material, normals
/// kept, colours from the materials (vertex colours and textures are left out). Root nodes are turned from the
/// mesh frame to glTF's y up, so that read_polygon_mesh gives the same mesh back.
/// Deterministic. Source: Khronos glTF 2.0 specification, sections 3 and 4.
std::vector<char> glb_bytes(const PolygonMesh& mesh);

/// Writes glb_bytes; the file appears complete or not at all.
lod::Result<lod::Ok> write_glb(const std::string& path, const PolygonMesh& mesh);

}  // namespace data
