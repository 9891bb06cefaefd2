// GeometryPool: the one vertex and the one index buffer of the scene, and the sky's triangle at their end.
//
//     vertices  [ fronts' regions ............ capacity.vertices | sky 3 ]
//     indices   [ fronts' regions ............ capacity.indices  | sky 3 ]
#pragma once

#include "lod/draw_list.h"
#include "render/mapped_array.h"
#include "render/renderer.h"

namespace render {

struct GeometryPool {
    MappedArray<lod::Vertex> vertices;
    MappedArray<uint32_t> indices;
    lod::DrawItem sky;  ///< covers the picture at infinity; its instance is for the caller to set
};

lod::Result<GeometryPool> make_geometry_pool(const PoolCapacity& capacity);

/// Places the list's writes; CHECKs that they lie in the pool and spare the sky. @returns bytes written
uint64_t place_writes(const lod::DrawList& list, GeometryPool& pool);

}  // namespace render
