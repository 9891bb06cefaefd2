#include "render/shaders.h"

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>

#include "lod/draw_list.h"
#include "render/frame_block.h"
#include "render/surface_pattern.h"
#include "render_shaders.h"

namespace render {

namespace {

template <typename Enum>
requires std::is_enum_v<Enum> std::string constant(const char* name, Enum value) {
    return "const uint " + std::string(name) + " = " + std::to_string(static_cast<unsigned>(value)) + "u;\n";
}

std::string constant(const char* name, double value) {
    return "const float " + std::string(name) + " = " + std::to_string(value) + ";\n";
}

std::string constant(const char* name, bool value) {
    return "const bool " + std::string(name) + (value ? " = true;\n" : " = false;\n");
}

std::string preamble(const ShaderFeatures& features) {
    return "#version 450 core\n" + constant("kHasTextures", features.has_textures) +
           constant("kHasAir", features.has_air) + constant("kGround", lod::Material::kGround) +
           constant("kWall", lod::Material::kWall) + constant("kRoof", lod::Material::kRoof) +
           constant("kPaint", lod::Material::kPaint) + constant("kGlow", lod::Material::kGlow) +
           constant("kGlass", lod::Material::kGlass) + constant("kSky", lod::Material::kSky) +
           constant("kWallFoot", lod::Material::kWallFoot) + constant("kAllRound", lod::Material::kAllRound) +
           constant("kPlain", Pattern::kPlain) + constant("kGrain", Pattern::kGround) +
           constant("kRoofing", Pattern::kRoof) + constant("kFirstFacade", Pattern::kHouse) +
           constant("kRoofTilesPerMetre", 1.0 / kRoofTile_m) +
           constant("kFacadeTilesPerMetre", 1.0 / kFacadeTile_m) + constant("kPerNeutral", 255.0 / kNeutral);
}

/// The driver's log up to its first line break.
std::string first_line(const std::array<char, 1024>& log) {
    const std::string text(log.data());
    return text.substr(0, text.find('\n'));
}

lod::Result<lod::Ok> compile(GLuint shader, const std::string& head, const char* body, const char* name) {
    const std::array<const char*, 3> parts{head.c_str(), glsl::kFrame, body};
    glShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return lod::Ok{};
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    return lod::Error{"the driver rejects shader " + std::string(name) + ": " + first_line(log)};
}

struct Member {
    const char* name;
    size_t offset;
};

constexpr std::array kFrameMembers{
    Member{"projection", offsetof(FrameBlock, projection)},
    Member{"ray", offsetof(FrameBlock, ray)},
    Member{"sun_eye", offsetof(FrameBlock, sun_eye)},
    Member{"up_eye", offsetof(FrameBlock, up_eye)},
    Member{"haze", offsetof(FrameBlock, haze)},
    Member{"ground_tiles", offsetof(FrameBlock, ground_tiles)},
    Member{"ground_phase", offsetof(FrameBlock, ground_phase)},
    Member{"ground_grid", offsetof(FrameBlock, ground_grid)},
};

GLint offset_of(GLuint program, const char* name) {
    const GLuint index = glGetProgramResourceIndex(program, GL_UNIFORM, name);
    GLint offset = -1;
    if (index == GL_INVALID_INDEX) return offset;
    constexpr GLenum kOffset = GL_OFFSET;
    glGetProgramResourceiv(program, GL_UNIFORM, index, 1, &kOffset, 1, nullptr, &offset);
    return offset;
}

lod::Result<lod::Ok> check_layout(GLuint program) {
    for (const Member& member : kFrameMembers) {
        const GLint offset = offset_of(program, member.name);
        if (offset != static_cast<GLint>(member.offset)) {
            return lod::Error{"shader member " + std::string(member.name) + " lies at byte " +
                              std::to_string(offset) + ", expected " + std::to_string(member.offset)};
        }
    }
    return lod::Ok{};
}

}  // namespace

lod::Result<Program> make_scene_program(const ShaderFeatures& features) {
    const std::string head = preamble(features);
    const VertexShader vertex = VertexShader::create();
    const FragmentShader fragment = FragmentShader::create();
    if (auto ok = compile(vertex.id(), head, glsl::kSceneVertex, "scene.vert"); !ok) return ok.error();
    if (auto ok = compile(fragment.id(), head, glsl::kSceneFragment, "scene.frag"); !ok) return ok.error();

    Program program = Program::create();
    glAttachShader(program.id(), vertex.id());
    glAttachShader(program.id(), fragment.id());
    glLinkProgram(program.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        std::array<char, 1024> log{};
        glGetProgramInfoLog(program.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        return lod::Error{"the driver cannot link the scene shaders: " + first_line(log)};
    }
    if (auto ok = check_layout(program.id()); !ok) return ok.error();
    return program;
}

}  // namespace render
