// EglContext: an OpenGL 4.5 core context without any window or screen.
#pragma once

#include <epoxy/egl.h>

#include "lod/base/result.h"
#include "render/glx_absence.h"

namespace render {

/// Current on the creating thread from creation to destruction. Move-only.
class EglContext {
  public:
    /// Tries, in this order: Mesa's surfaceless platform, the first EGL device, the default display.
    /// Fails with one line when none of them gives an OpenGL 4.5 core context.
    static lod::Result<EglContext> create();

    EglContext(EglContext&& other) noexcept;
    EglContext& operator=(EglContext&& other) noexcept;
    ~EglContext();

  private:
    EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    GlxAbsence glx_absence_;
};

}  // namespace render
