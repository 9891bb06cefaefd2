// GlxAbsence: while it lives, epoxy takes for granted that no GLX context is current.
//
// Between its first OpenGL calls epoxy asks libGL for a GLX context, even when EGL has made the context. A call
// tracer that stands in for EGL alone has no answer to that, and epoxy ends the program (epoxy 1.5.10 under
// apitrace's egltrace). With this, `apitrace trace --api egl` records every call of a windowless run.
#pragma once

#include <utility>

namespace render {

/// Move-only; one at a time. The answer before is put back at the end.
class GlxAbsence {
  public:
    GlxAbsence();
    GlxAbsence(GlxAbsence&& other) noexcept : before_(std::exchange(other.before_, nullptr)) {}
    GlxAbsence& operator=(GlxAbsence&& other) noexcept {
        std::swap(before_, other.before_);
        return *this;
    }
    ~GlxAbsence();

  private:
    using Answer = void (*)();
    Answer before_ = nullptr;  ///< epoxy's own way to glXGetCurrentContext
};

}  // namespace render
