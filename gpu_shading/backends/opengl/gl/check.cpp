#include "backends/opengl/gl/check.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <string>

#include "gpu_shading/error.h"

namespace gpu_shading::gl {
namespace {

char const* name_of(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    default:
      return "unknown GL error";
  }
}

// The messages of a debug context since the last call; without one, there are none.
std::string logged_misuse() {
  constexpr std::size_t longest = 4096;
  std::string all;
  std::array<char, longest> text{};
  while (glGetDebugMessageLog(1, static_cast<GLsizei>(text.size()), nullptr, nullptr, nullptr,
                              nullptr, nullptr, text.data()) > 0) {
    all += all.empty() ? "" : "; ";
    all += text.data();
  }
  return all;
}

}  // namespace

void check(char const* doing) {
  GLenum const error = glGetError();
  if (error == GL_OUT_OF_MEMORY) {
    throw DeviceError(fmt::format(
        "the device ran out of memory while {} (GL_OUT_OF_MEMORY); lower the resolution", doing));
  }
  if (error == GL_CONTEXT_LOST || glGetGraphicsResetStatus() != GL_NO_ERROR) {
    throw DeviceError(fmt::format(
        "the device was lost while {} (GL_CONTEXT_LOST): it was reset or its driver stopped",
        doing));
  }
  std::string const misuse = logged_misuse();
  if (error == GL_NO_ERROR && misuse.empty()) return;
  std::string const what =
      error == GL_NO_ERROR ? "OpenGL misused" : fmt::format("{} ({:#06x})", name_of(error), error);
  throw Error(fmt::format("{} while {}{}{}; this is a bug in gpu_shading", what, doing,
                          misuse.empty() ? "" : ": ", misuse));
}

void log_misuse() {
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
  for (GLenum const type : {GL_DEBUG_TYPE_ERROR, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR}) {
    glDebugMessageControl(GL_DONT_CARE, type, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  }
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
}

}  // namespace gpu_shading::gl
