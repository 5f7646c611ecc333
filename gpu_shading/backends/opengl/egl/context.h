#pragma once

#include "backends/opengl/egl/display.h"

namespace gpu_shading::egl {

// Restores the previous context of this thread at the end of its scope.
class Current {
 public:
  Current(Current const&) = delete;
  Current& operator=(Current const&) = delete;
  ~Current();

 private:
  friend class Context;
  Current(void* display, void* context);

  unsigned previous_api_ = 0;
  void* previous_display_ = nullptr;
  void* previous_draw_ = nullptr;
  void* previous_read_ = nullptr;
  void* previous_context_ = nullptr;
  void* display_ = nullptr;
};

// An OpenGL 4.5 core context without a surface. Empty when moved from.
class Context {
 public:
  // Throws DeviceError, naming the display, the function, the decoded error and what to try.
  // `debug`: it reports misuse (gl::log_misuse).
  explicit Context(Display const& display, bool debug = false);
  ~Context();
  Context(Context const&) = delete;
  Context& operator=(Context const&) = delete;
  Context(Context&& other) noexcept;
  Context& operator=(Context&& other) noexcept;

  // Makes it the current context of this thread for the lifetime of the result. Throws DeviceError.
  [[nodiscard]] Current make_current() const;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace gpu_shading::egl
