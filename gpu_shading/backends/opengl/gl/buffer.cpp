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

void Buffer::set_size(std::size_t bytes) {
  glNamedBufferData(name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_COPY);
  check("allocating a buffer");
}

void Buffer::clear(std::size_t bytes) {
  glClearNamedBufferSubData(name(), GL_R32UI, 0, static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER,
                            GL_UNSIGNED_INT, nullptr);
}

void Buffer::copy_to(Buffer& to, std::size_t bytes) const {
  glCopyNamedBufferSubData(name(), to.name(), 0, 0, static_cast<GLsizeiptr>(bytes));
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
