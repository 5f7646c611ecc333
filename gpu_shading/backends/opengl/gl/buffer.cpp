#include "backends/opengl/gl/buffer.h"

#include <epoxy/gl.h>

#include "backends/opengl/gl/check.h"

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

std::byte const* Buffer::set_shared_size(std::size_t bytes) {
  constexpr GLbitfield shared = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  auto const size = static_cast<GLsizeiptr>(bytes);
  glNamedBufferStorage(name(), size, nullptr, shared);
  void const* const address = glMapNamedBufferRange(name(), 0, size, shared);
  check("allocating a read-back buffer");
  return static_cast<std::byte const*>(address);
}

void Buffer::bind_storage(std::uint32_t binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name());
}

}  // namespace gpu_shading::gl
