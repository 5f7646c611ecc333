#include "backends/opengl/gl/fence.h"

#include <epoxy/gl.h>

#include "backends/opengl/gl/check.h"
#include "gpu_shading/error.h"

namespace gpu_shading::gl {

Fence Fence::here() {
  Fence fence;
  fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
  return fence;
}

Fence::~Fence() {
  if (sync_ != nullptr) glDeleteSync(static_cast<GLsync>(sync_));
}

void Fence::wait() const {
  constexpr GLuint64 a_second = 1'000'000'000;
  for (;;) {
    GLenum const found = glClientWaitSync(static_cast<GLsync>(sync_), 0, a_second);
    if (found == GL_ALREADY_SIGNALED || found == GL_CONDITION_SATISFIED) return;
    check("waiting for the device");
    if (found == GL_WAIT_FAILED) throw DeviceError("the device did not finish drawing");
  }
}

}  // namespace gpu_shading::gl
