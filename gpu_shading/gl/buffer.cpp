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

void Buffer::set_size(std::size_t bytes) {
  glNamedBufferData(name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
}

void Buffer::bind_uniform(std::uint32_t binding, std::size_t offset, std::size_t size) const {
  glBindBufferRange(GL_UNIFORM_BUFFER, binding, name(), static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(size));
}

void Buffer::bind_storage(std::uint32_t binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name());
}

std::vector<float> Buffer::read_floats(std::size_t count) const {
  std::vector<float> values(count);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(name(), 0, static_cast<GLsizeiptr>(count * sizeof(float)), values.data());
  return values;
}

}  // namespace gpu_shading::gl
