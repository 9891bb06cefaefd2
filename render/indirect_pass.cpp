#include "render/indirect_pass.h"

#include <algorithm>
#include <optional>

namespace render {

namespace {

constexpr GLuint kVertexBinding = 0, kInstanceBinding = 1;

/// One input of shaders/scene.vert that four floats of an instance fill.
void add_instance_attribute(GLuint array, GLuint location, size_t offset) {
    glEnableVertexArrayAttrib(array, location);
    glVertexArrayAttribBinding(array, location, kInstanceBinding);
    glVertexArrayAttribFormat(array, location, 4, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
}

/// Mirrors lod::Vertex, lod::Instance and the inputs of shaders/scene.vert.
VertexArray make_vertex_array() {
    VertexArray array = VertexArray::create();
    const GLuint id = array.id();
    for (GLuint location = 0; location < 4; ++location) {
        glEnableVertexArrayAttrib(id, location);
        glVertexArrayAttribBinding(id, location, kVertexBinding);
    }
    glVertexArrayAttribFormat(id, 0, 3, GL_FLOAT, GL_FALSE, offsetof(lod::Vertex, position_hi));
    glVertexArrayAttribFormat(id, 1, 3, GL_FLOAT, GL_FALSE, offsetof(lod::Vertex, position_lo));
    glVertexArrayAttribIFormat(id, 2, 2, GL_UNSIGNED_SHORT, offsetof(lod::Vertex, surface));
    glVertexArrayAttribIFormat(id, 3, 4, GL_UNSIGNED_BYTE, offsetof(lod::Vertex, colour));
    for (GLuint row = 0; row < 3; ++row)
        add_instance_attribute(
            id, 4 + row,
            offsetof(lod::Instance, eye_from_model) + row * sizeof(lod::Instance::eye_from_model[0]));
    add_instance_attribute(id, 7, offsetof(lod::Instance, origin_hi));
    add_instance_attribute(id, 8, offsetof(lod::Instance, origin_lo));
    add_instance_attribute(id, 9, offsetof(lod::Instance, up_eye));
    glVertexArrayBindingDivisor(id, kInstanceBinding, 1);
    return array;
}

lod::Instance sky_instance() {
    lod::Instance instance{};
    instance.module = static_cast<uint32_t>(lod::Module::kSky);
    return instance;
}

/// Reversed depth, infinitely far; premultiplied blending for the whole draw when there is glass in it, which opaque
/// surfaces (alpha 1) do not notice. Both faces are drawn: models with one-sided sheets are common.
void set_state(bool has_glass) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);  // equal: the sky lies at 0, where the buffer was cleared to
    has_glass ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
}

}  // namespace

lod::Result<IndirectPass> make_indirect_pass(uint32_t command_capacity) {
    IndirectPass pass;
    for (size_t i = 0; i < pass.programs.size(); ++i) {
        auto program = make_scene_program({.has_textures = (i & 1) != 0, .has_air = (i & 2) != 0});
        if (!program) return program.error();
        pass.programs[i] = std::move(*program);
    }
    auto frame = MappedArray<FrameBlock>::create(1, "frame");
    if (!frame) return frame.error();
    pass.vertex_array = make_vertex_array();
    pass.frame = std::move(*frame);
    if (auto resized = resize_commands(command_capacity, pass); !resized) return resized.error();
    return pass;
}

lod::Result<lod::Ok> resize_commands(uint32_t capacity, IndirectPass& pass) {
    auto commands = MappedArray<DrawCommand>::create(size_t{capacity} + 1, "command");
    if (!commands) return commands.error();
    auto instances = MappedArray<lod::Instance>::create(size_t{capacity} + 1, "instance");
    if (!instances) return instances.error();
    pass.commands = std::move(*commands);
    pass.instances = std::move(*instances);
    pass.command_count = pass.instance_count = 0;
    return lod::Ok{};
}

uint32_t command_capacity(const IndirectPass& pass) {
    return static_cast<uint32_t>(pass.commands.size() - 1);
}

uint64_t upload_frame(const lod::DrawList& list, const GeometryPool& pool, const FrameBlock& frame,
                      bool draws_sky, IndirectPass& pass) {
    const lod::Instance sky = sky_instance();
    uint64_t bytes = pass.instances.write(0, list.instances);
    bytes += pass.instances.write(list.instances.size(), std::span(&sky, 1));
    bytes += pass.frame.write(0, std::span(&frame, 1));

    std::optional<lod::DrawItem> sky_item;
    if (draws_sky) {
        sky_item = pool.sky;
        sky_item->instance = static_cast<uint32_t>(list.instances.size());
    }
    const size_t count = build_commands(list.items, sky_item, pass.commands.elements());
    pass.command_count = static_cast<uint32_t>(count);
    pass.has_glass = std::any_of(list.items.begin(), list.items.end(),
                                 [](const lod::DrawItem& item) { return item.is_glass; });
    pass.instance_count = static_cast<uint32_t>(list.instances.size() + 1);
    return bytes + count * sizeof(DrawCommand);
}

void submit(const GeometryPool& pool, const SurfaceTextures& textures, const ShaderFeatures& features,
            const IndirectPass& pass) {
    set_state(pass.has_glass);
    glVertexArrayVertexBuffer(pass.vertex_array.id(), kVertexBinding, pool.vertices.id(), 0,
                              sizeof(lod::Vertex));
    glVertexArrayVertexBuffer(pass.vertex_array.id(), kInstanceBinding, pass.instances.id(), 0,
                              sizeof(lod::Instance));
    glVertexArrayElementBuffer(pass.vertex_array.id(), pool.indices.id());
    glBindVertexArray(pass.vertex_array.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, pass.commands.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, pass.frame.id());
    glBindTextureUnit(0, textures.ground.id());
    glBindTextureUnit(1, textures.patterns.id());
    glUseProgram(pass.programs[size_t{features.has_textures} + 2 * size_t{features.has_air}].id());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                                static_cast<GLsizei>(pass.command_count), sizeof(DrawCommand));
}

}  // namespace render
