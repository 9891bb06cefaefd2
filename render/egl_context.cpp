#include "render/egl_context.h"

#include <array>
#include <utility>

namespace render {

namespace {

EGLDisplay surfaceless_display() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) return EGL_NO_DISPLAY;
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLDisplay device_display() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        return EGL_NO_DISPLAY;
    }
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (eglQueryDevicesEXT(1, &device, &count) != EGL_TRUE || count < 1) return EGL_NO_DISPLAY;
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
}

EGLDisplay default_display() {
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

/// Any configuration will do: the context draws into its own framebuffer objects only.
EGLConfig config_of(EGLDisplay display) {
    constexpr std::array<EGLint, 5> kWanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                            EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    if (eglChooseConfig(display, kWanted.data(), &config, 1, &count) != EGL_TRUE || count < 1) {
        return EGL_NO_CONFIG_KHR;
    }
    return config;
}

/// A current context on `display`, or none.
EGLContext context_on(EGLDisplay display) {
    constexpr std::array<EGLint, 7> kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                             4,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             5,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
        return EGL_NO_CONTEXT;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
    const EGLContext context = eglCreateContext(display, config_of(display), EGL_NO_CONTEXT, kVersion.data());
    if (context == EGL_NO_CONTEXT) return EGL_NO_CONTEXT;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return context;
    eglDestroyContext(display, context);
    return EGL_NO_CONTEXT;
}

}  // namespace

lod::Result<EglContext> EglContext::create() {
    for (auto* display_maker : {surfaceless_display, device_display, default_display}) {
        const EGLDisplay display = display_maker();
        const EGLContext context = context_on(display);
        if (context != EGL_NO_CONTEXT) return EglContext(display, context);
    }
    return lod::Error{
        "no OpenGL 4.5 core context through EGL, expected a GPU driver or Mesa (libegl-mesa0, "
        "libgl1-mesa-dri)"};
}

EglContext::EglContext(EglContext&& other) noexcept
    : display_(std::exchange(other.display_, EGL_NO_DISPLAY)),
      context_(std::exchange(other.context_, EGL_NO_CONTEXT)),
      glx_absence_(std::move(other.glx_absence_)) {}

EglContext& EglContext::operator=(EglContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(context_, other.context_);
    std::swap(glx_absence_, other.glx_absence_);
    return *this;
}

EglContext::~EglContext() {
    if (context_ == EGL_NO_CONTEXT) return;
    // The display stays initialised: EGL hands the same one to every context of the process.
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
}

}  // namespace render
