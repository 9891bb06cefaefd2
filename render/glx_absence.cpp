#include "render/glx_absence.h"

#include <epoxy/glx.h>

namespace render {

namespace {

GLXContext no_context() {
    return nullptr;
}

}  // namespace

GlxAbsence::GlxAbsence() : before_(reinterpret_cast<Answer>(epoxy_glXGetCurrentContext)) {
    epoxy_glXGetCurrentContext = no_context;
}

GlxAbsence::~GlxAbsence() {
    if (before_ == nullptr) return;
    epoxy_glXGetCurrentContext = reinterpret_cast<decltype(epoxy_glXGetCurrentContext)>(before_);
}

}  // namespace render
