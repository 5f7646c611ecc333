#include "gl/vertex_array.h"

#include <epoxy/gl.h>

namespace gpu_shading::gl {

void destroy_vertex_array(std::uint32_t name) { glDeleteVertexArrays(1, &name); }

VertexArray VertexArray::create() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

void VertexArray::set_vertices(Buffer const& buffer, std::size_t stride) {
  glVertexArrayVertexBuffer(name(), 0, buffer.name(), 0, static_cast<GLsizei>(stride));
}

void VertexArray::add_attribute(std::uint32_t location, int components, std::size_t offset) {
  glEnableVertexArrayAttrib(name(), location);
  glVertexArrayAttribFormat(name(), location, components, GL_FLOAT, GL_FALSE,
                            static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(name(), location, 0);
}

void VertexArray::add_identity(std::uint32_t location, std::size_t offset) {
  glEnableVertexArrayAttrib(name(), location);
  glVertexArrayAttribIFormat(name(), location, 1, GL_UNSIGNED_INT, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(name(), location, 0);
}

void VertexArray::set_indices(Buffer const& buffer) {
  glVertexArrayElementBuffer(name(), buffer.name());
}

void VertexArray::bind() const { glBindVertexArray(name()); }

}  // namespace gpu_shading::gl
