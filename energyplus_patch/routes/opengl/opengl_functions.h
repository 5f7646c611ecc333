#pragma once

#include <exception>
#include <memory>
#include <string>
#include <string_view>

#include "routes/opengl/queries/recorder.h"

namespace gpu_shading::energyplus {

// From now on, contexts of this process ask about this model.
void draw_with(DrawnModel::Input input);
// EnergyPlus has ended: the calculation reports what it rendered. Throws Error.
void finish_drawing();

// As DrawnModel::fail(), if there is a model.
void fail_drawing(std::string const& why);

// The model of a new context: that of draw_with(), or one that is known by its triangles alone.
std::shared_ptr<DrawnModel> model_of_context();

// Called while an exception is handled: prints it and ends the run, since EnergyPlus would go on
// with wrong answers. TaskDone ends it without a message. On Windows, that is the end of the
// process; elsewhere, an exception that EnergyPlus catches and reports.
[[noreturn]] void end_run(std::exception const& error);

template <typename Action>
void or_end_run(Action const& action) {
  try {
    action();
  } catch (std::exception const& error) {
    end_run(error);
  }
}

// An OpenGL context: Penumbra has one for each model.
struct OpenGlContext {
  Recorder recorder{model_of_context()};
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
