// MappedArray: a GPU buffer of T that stays mapped for as long as it lives; writing it is a memcpy.
//
// Persistent and coherent: no flush, no unmap, no driver call per write. The caller fences: nothing may be
// overwritten that a submitted draw still reads.
#pragma once

#include <epoxy/gl.h>

#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "lod/base/result.h"
#include "render/gl_handle.h"

namespace render {

template <typename T>
class MappedArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    MappedArray() = default;

    /// A new buffer of `count` > 0 elements, contents undefined. `what` names it in the error.
    static lod::Result<MappedArray> create(size_t count, const char* what) {
        constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        const auto size_bytes = static_cast<GLsizeiptr>(count * sizeof(T));
        MappedArray array;
        array.buffer_ = Buffer::create();
        glNamedBufferStorage(array.buffer_.id(), size_bytes, nullptr, kFlags);
        auto* data = static_cast<T*>(glMapNamedBufferRange(array.buffer_.id(), 0, size_bytes, kFlags));
        if (data == nullptr) {
            return lod::Error{"no GPU memory for the " + std::string(what) + " buffer, expected " +
                              std::to_string(size_bytes) + " bytes to be free"};
        }
        array.elements_ = {data, count};
        return array;
    }

    GLuint id() const { return buffer_.id(); }
    size_t size() const { return elements_.size(); }

    /// Places `source` from element `first` on; CHECKs that it fits. @returns bytes written
    size_t write(size_t first, std::span<const T> source) {
        CHECK(first <= size() && source.size() <= size() - first);
        if (!source.empty()) std::memcpy(elements_.data() + first, source.data(), source.size_bytes());
        return source.size_bytes();
    }

    /// What the GPU holds, from element `first` on. Waits for the draws that use the buffer.
    std::vector<T> read(size_t first, size_t count) const {
        CHECK(first <= size() && count <= size() - first);
        std::vector<T> out(count);
        if (count > 0) {
            glGetNamedBufferSubData(id(), static_cast<GLintptr>(first * sizeof(T)),
                                    static_cast<GLsizeiptr>(count * sizeof(T)), out.data());
        }
        return out;
    }

    /// The mapped memory itself: write only, in order; reading it can be very slow.
    std::span<T> elements() { return elements_; }

  private:
    Buffer buffer_;
    std::span<T> elements_;
};

}  // namespace render
