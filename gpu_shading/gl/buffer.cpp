#include "gl/buffer.h"

#include <epoxy/gl.h>

namespace gpu_shading::gl {

void destroy_buffer(std::uint32_t name) { glDeleteBuffers(1, &name); }

Buffer Buffer::create() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return Buffer(name);
}

void Buffer::set_data(std::span<std::byte const> bytes) {
  glNamedBufferData(name(), static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STREAM_DRAW);
}

void Buffer::bind_uniform(std::uint32_t binding, std::size_t offset, std::size_t size) const {
  glBindBufferRange(GL_UNIFORM_BUFFER, binding, name(), static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(size));
}

}  // namespace gpu_shading::gl
