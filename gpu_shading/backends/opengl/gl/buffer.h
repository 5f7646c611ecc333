#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "backends/opengl/gl/object.h"

namespace gpu_shading::gl {

void destroy_buffer(std::uint32_t name);

class Buffer : public Object<destroy_buffer> {
 public:
  Buffer() = default;
  static Buffer create();

  // Replaces the contents. Earlier draws keep the old storage.
  void set_data(std::span<std::byte const> bytes);

  // Allocates this many bytes that the device writes and the CPU reads; the address is valid for
  // the lifetime of the buffer. Call it once.
  std::byte const* set_shared_size(std::size_t bytes);

  template <typename T>
  void set(std::span<T const> values) {
    set_data(std::as_bytes(values));
  }

  // Binds the whole buffer as a shader storage block.
  void bind_storage(std::uint32_t binding) const;

 private:
  using Object::Object;
};

}  // namespace gpu_shading::gl
