#include "backends/opengl/gl/readback.h"

#include <epoxy/gl.h>

#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/draw.h"
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

Readback::Readback(LayeredTexture const& texture, Mode mode) : texture_(texture) {
  if (mode == Mode::ahead) {
    buffer_ = Buffer::create();
    ahead_ = buffer_.set_shared_size(bytes(texture, mode));
  } else {
    asked_.resize(bytes(texture, mode));
  }
}

std::size_t Readback::bytes(LayeredTexture const& texture, Mode mode) {
  return texture.layer_size() *
         (mode == Mode::ahead ? static_cast<std::size_t>(texture.layers()) : 1);
}

void Readback::start(int layers) {
  if (ahead_ == nullptr) return;
  texture_.copy(layers, buffer_);
  share_written();
}

std::byte const* Readback::find(int layer) {
  if (ahead_ != nullptr) return ahead_ + texture_.layer_size() * static_cast<std::size_t>(layer);
  texture_.read(layer, asked_);
  return asked_.data();
}

}  // namespace gpu_shading::gl
