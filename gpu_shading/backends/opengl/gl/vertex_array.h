#pragma once

#include <cstddef>
#include <cstdint>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/object.h"

namespace gpu_shading::gl {

void destroy_vertex_array(std::uint32_t name);

class VertexArray : public Object<destroy_vertex_array> {
 public:
  VertexArray() = default;
  static VertexArray create();

  // Sets per-vertex data in `buffer`, every `stride` bytes; attributes are added from offset 0 on.
  void set_vertices(Buffer const& buffer, std::size_t stride);
  // Sets per-instance data likewise.
  void set_records(Buffer const& buffer, std::size_t stride);

  enum class Of { vertices, records };
  void add_floats(Of of, std::uint32_t location, int components, std::size_t offset);
  void add_integers(Of of, std::uint32_t location, int components, std::size_t offset);
  void set_indices(Buffer const& buffer);  // of 32 bits
  void bind() const;

 private:
  using Object::Object;
};

}  // namespace gpu_shading::gl
