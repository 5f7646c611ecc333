#include "backends/opengl/gl/vertex_array.h"

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

void VertexArray::set_records(Buffer const& buffer, std::size_t stride) {
  glVertexArrayVertexBuffer(name(), 1, buffer.name(), 0, static_cast<GLsizei>(stride));
  glVertexArrayBindingDivisor(name(), 1, 1);
}

void VertexArray::add_floats(Of of, std::uint32_t location, int components, std::size_t offset) {
  glEnableVertexArrayAttrib(name(), location);
  glVertexArrayAttribFormat(name(), location, components, GL_FLOAT, GL_FALSE,
                            static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(name(), location, of == Of::records ? 1 : 0);
}

void VertexArray::add_integers(Of of, std::uint32_t location, int components, std::size_t offset) {
  glEnableVertexArrayAttrib(name(), location);
  glVertexArrayAttribIFormat(name(), location, components, GL_INT, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(name(), location, of == Of::records ? 1 : 0);
}

void VertexArray::set_indices(Buffer const& buffer) {
  glVertexArrayElementBuffer(name(), buffer.name());
}

void VertexArray::bind() const { glBindVertexArray(name()); }

}  // namespace gpu_shading::gl
