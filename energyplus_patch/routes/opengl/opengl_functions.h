#pragma once

#include <string_view>

#include "routes/opengl/opengl_answers.h"
#include "routes/opengl/queries/recorder.h"

namespace gpu_shading::energyplus {

// An OpenGL context: Penumbra has one for each model.
struct OpenGlContext {
  Recorder recorder{answers_of_run()};
  void* device = nullptr;  // of the window system's
};

inline constexpr char const* opengl_extensions =
    "GL_ARB_vertex_array_object GL_EXT_framebuffer_object";

// The context that this thread's functions of OpenGL are about; null: none.
void use_context(OpenGlContext* context);
OpenGlContext* current_context();

// The function of OpenGL that GLFW or Penumbra calls by this name; one that does nothing for those
// that change nothing here.
void* opengl_function(std::string_view name);

}  // namespace gpu_shading::energyplus
