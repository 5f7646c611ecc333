#pragma once

#include <cstddef>
#include <cstdint>

#include "gl/buffer.h"
#include "gl/object.h"

namespace gpu_shading::gl {

void destroy_vertex_array(std::uint32_t name);

class VertexArray : public Object<destroy_vertex_array> {
 public:
  VertexArray() = default;
  static VertexArray create();

  // Floats of `buffer`, one vertex each `stride` bytes; attributes are added from offset 0 on.
  void set_vertices(Buffer const& buffer, std::size_t stride);
  void add_attribute(std::uint32_t location, int components, std::size_t offset);
  void add_identity(std::uint32_t location, std::size_t offset);  // an unsigned integer
  void set_indices(Buffer const& buffer);                         // of 32 bits
  void bind() const;

 private:
  using Object::Object;
};

}  // namespace gpu_shading::gl
