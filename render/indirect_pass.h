// IndirectPass: everything that turns a filled pool into a picture with one glMultiDrawElementsIndirect.
#pragma once

#include <array>
#include <span>

#include "lod/base/result.h"
#include "lod/draw_list.h"
#include "render/draw_command.h"
#include "render/frame_block.h"
#include "render/geometry_pool.h"
#include "render/mapped_array.h"
#include "render/shaders.h"

namespace render {

struct IndirectPass {
    std::array<Program, 4> programs;       ///< has_textures + 2 * has_air
    VertexArray vertex_array;              ///< lod::Vertex as the shader's inputs
    MappedArray<DrawCommand> commands;     ///< capacity + 1: the sky
    MappedArray<lod::Instance> instances;  ///< capacity + 1: the sky
    MappedArray<FrameBlock> frame;         ///< 1
    uint32_t command_count = 0;            ///< of the last frame, sky included
    uint32_t instance_count = 0;           ///< of the last frame, sky included
    bool has_glass = false;                ///< in the last frame
};

lod::Result<IndirectPass> make_indirect_pass(uint32_t command_capacity);

/// Room for so many items and instances; contents are lost.
lod::Result<lod::Ok> resize_commands(uint32_t capacity, IndirectPass& pass);

/// Items or instances that fit.
uint32_t command_capacity(const IndirectPass& pass);

/// Writes commands, instances and the frame block. Nothing may be in flight. @returns bytes written
uint64_t upload_frame(const lod::DrawList& list, const GeometryPool& pool, const FrameBlock& frame,
                      bool draws_sky, IndirectPass& pass);

/// What surfaces are painted with.
struct SurfaceTextures {
    Texture2D ground;
    TextureArray patterns;
};

/// Binds pool, records and textures and submits the one draw call into the bound framebuffer.
void submit(const GeometryPool& pool, const SurfaceTextures& textures, const ShaderFeatures& features,
            const IndirectPass& pass);

}  // namespace render
