// GlHandle: sole owner of one OpenGL object; one move-only type per kind of object.
//
// Must be destroyed while the context that made it is current. Sync objects have a type of their own because
// their name is a pointer.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace render {

/// Owns one object name; 0 is "none". `Kind` tells how such an object is made and deleted.
template <typename Kind>
class GlHandle {
  public:
    GlHandle() = default;
    GlHandle(GlHandle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlHandle() {
        if (id_ != 0) Kind::destroy(id_);
    }

    static GlHandle create() {
        GlHandle handle;
        handle.id_ = Kind::create();
        return handle;
    }

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

  private:
    GLuint id_ = 0;
};

struct BufferKind {
    static GLuint create() {
        GLuint id = 0;
        glCreateBuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};

struct TextureArrayKind {
    static GLuint create() {
        GLuint id = 0;
        glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};

struct Texture2DKind {
    static GLuint create() {
        GLuint id = 0;
        glCreateTextures(GL_TEXTURE_2D, 1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};

struct RenderbufferKind {
    static GLuint create() {
        GLuint id = 0;
        glCreateRenderbuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteRenderbuffers(1, &id); }
};

struct FramebufferKind {
    static GLuint create() {
        GLuint id = 0;
        glCreateFramebuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};

struct VertexArrayKind {
    static GLuint create() {
        GLuint id = 0;
        glCreateVertexArrays(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};

struct ProgramKind {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint id) { glDeleteProgram(id); }
};

struct VertexShaderKind {
    static GLuint create() { return glCreateShader(GL_VERTEX_SHADER); }
    static void destroy(GLuint id) { glDeleteShader(id); }
};

struct FragmentShaderKind {
    static GLuint create() { return glCreateShader(GL_FRAGMENT_SHADER); }
    static void destroy(GLuint id) { glDeleteShader(id); }
};

using Buffer = GlHandle<BufferKind>;
using TextureArray = GlHandle<TextureArrayKind>;
using Texture2D = GlHandle<Texture2DKind>;
using Renderbuffer = GlHandle<RenderbufferKind>;
using Framebuffer = GlHandle<FramebufferKind>;
using VertexArray = GlHandle<VertexArrayKind>;
using Program = GlHandle<ProgramKind>;
using VertexShader = GlHandle<VertexShaderKind>;
using FragmentShader = GlHandle<FragmentShaderKind>;

/// A point in the command stream that the CPU can wait for.
class Fence {
  public:
    Fence() = default;
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }
    ~Fence() { forget(); }

    /// Marks the end of everything submitted so far.
    void place() {
        forget();
        sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    }

    /// Blocks until the marked point has been passed; returns at once when there is none.
    void wait() {
        constexpr GLuint64 kSecond_ns = 1'000'000'000;
        while (sync_ != nullptr &&
               glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, kSecond_ns) == GL_TIMEOUT_EXPIRED) {
        }
        forget();
    }

  private:
    void forget() {
        if (sync_ != nullptr) glDeleteSync(std::exchange(sync_, nullptr));
    }
    GLsync sync_ = nullptr;
};

}  // namespace render
