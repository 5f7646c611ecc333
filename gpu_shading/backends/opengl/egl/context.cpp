#include "backends/opengl/egl/context.h"

#include <epoxy/egl.h>

#include <array>
#include <utility>
#include <vector>

#include "backends/opengl/egl/display.h"

namespace gpu_shading::egl {
namespace {

[[noreturn]] void fail(std::string const& label, char const* function, char const* hint) {
  throw DeviceError(label + ": " + describe_failure(function, hint));
}

EGLConfig find_config(EGLDisplay display, std::string const& label) {
  if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context") ||
      epoxy_has_egl_extension(display, "EGL_MESA_configless_context")) {
    return EGL_NO_CONFIG_KHR;
  }
  constexpr std::array<EGLint, 5> any = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                         EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, any.data(), &config, 1, &count) != EGL_TRUE || count == 0) {
    fail(label, "eglChooseConfig", "the driver does not support OpenGL without a screen");
  }
  return config;
}

EGLContext create(EGLDisplay display, EGLConfig config, bool debug) {
  std::vector<EGLint> wanted{EGL_CONTEXT_MAJOR_VERSION,       4,
                             EGL_CONTEXT_MINOR_VERSION,       5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
  // EGL 1.4 does not know EGL_CONTEXT_OPENGL_DEBUG.
  if (debug) {
    wanted.insert(wanted.end(), {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
  }
  std::vector<EGLint> told = wanted;
  told.insert(told.end(),
              {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  // A context that reports a lost device, if the driver supports that; otherwise a plain one.
  for (std::vector<EGLint>* const attributes : {&told, &wanted}) {
    attributes->push_back(EGL_NONE);
    EGLContext const context =
        eglCreateContext(display, config, EGL_NO_CONTEXT, attributes->data());
    if (context != EGL_NO_CONTEXT) return context;
  }
  return EGL_NO_CONTEXT;
}

// EGL has one current context per thread and client API: a host may have bound OpenGL ES.
class BoundApi {
 public:
  explicit BoundApi(std::string const& label) : previous_(eglQueryAPI()) {
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
      fail(label, "eglBindAPI(EGL_OPENGL_API)", "the driver does not support desktop OpenGL");
    }
  }
  BoundApi(BoundApi const&) = delete;
  BoundApi& operator=(BoundApi const&) = delete;
  ~BoundApi() { eglBindAPI(previous_); }

 private:
  EGLenum previous_;
};

}  // namespace

Context::Context(Display const& display, bool debug) : display_(display.handle) {
  if (eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) {
    fail(display.label, "eglInitialize",
         "check the driver, and that this user may open the device (/dev/dri, group render)");
  }
  BoundApi const api(display.label);
  if (!epoxy_has_egl_extension(display_, "EGL_KHR_surfaceless_context")) {
    throw DeviceError(display.label +
                      ": no EGL_KHR_surfaceless_context; update the graphics driver");
  }
  context_ = create(display_, find_config(display_, display.label), debug);
  if (context_ == EGL_NO_CONTEXT) {
    fail(display.label, "eglCreateContext(OpenGL 4.5 core)",
         "the device needs OpenGL 4.5; update its driver or choose the device 'cpu'");
  }
}

Context::~Context() {
  if (context_ != nullptr) eglDestroyContext(display_, context_);
}

Context::Context(Context&& other) noexcept
    : display_(other.display_), context_(std::exchange(other.context_, nullptr)) {}

Context& Context::operator=(Context&& other) noexcept {
  std::swap(display_, other.display_);
  std::swap(context_, other.context_);
  return *this;
}

Current Context::make_current() const { return Current(display_, context_); }

Current::Current(void* display, void* context)
    : previous_api_(eglQueryAPI()),
      previous_display_(eglGetCurrentDisplay()),
      previous_draw_(eglGetCurrentSurface(EGL_DRAW)),
      previous_read_(eglGetCurrentSurface(EGL_READ)),
      previous_context_(eglGetCurrentContext()),
      display_(display) {
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    std::string const what = describe_failure(
        "eglMakeCurrent", "the device was lost, or another thread is using this renderer");
    eglBindAPI(previous_api_);
    throw DeviceError(what);
  }
}

Current::~Current() {
  if (previous_context_ != EGL_NO_CONTEXT) {
    eglBindAPI(previous_api_);
    eglMakeCurrent(previous_display_, previous_draw_, previous_read_, previous_context_);
  } else {
    // Releases our context, so that another thread may use it.
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglBindAPI(previous_api_);
  }
}

}  // namespace gpu_shading::egl
