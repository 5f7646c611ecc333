#include "gl/check.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

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
  if (error != GL_NO_ERROR) {
    throw Error(fmt::format("{} ({:#06x}) while {}; this is a bug in gpu_shading", name_of(error),
                            error, doing));
  }
}

}  // namespace gpu_shading::gl
