// PLY: drawn triangles as a binary file that other programs open.
#pragma once

#include <string>

#include "lod/base/result.h"
#include "render/renderer.h"

namespace sim {

/// Writes binary little-endian PLY: vertices double x, y, z in world metres; faces a list of three int indices and
/// uchar module (0 terrain, 1 objects, 2 instruments). Corners that agree bit for bit within a module are one vertex.
/// Fails on an unwritable path; the file appears complete or not at all.
lod::Result<lod::Ok> write_ply(const std::string& path, const render::DrawnTriangles& triangles);

}  // namespace sim
