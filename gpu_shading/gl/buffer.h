#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "gl/object.h"

namespace gpu_shading::gl {

void destroy_buffer(std::uint32_t name);

class Buffer : public Object<destroy_buffer> {
 public:
  Buffer() = default;
  static Buffer create();

  // Replaces the contents. Storage in use by earlier draws is left to them.
  void set_data(std::span<std::byte const> bytes);

  // Room for as many bytes, for the device to write and this side to see: the address stays good as
  // long as the buffer. Once.
  std::byte const* set_shared_size(std::size_t bytes);

  template <typename T>
  void set(std::span<T const> values) {
    set_data(std::as_bytes(values));
  }

  // All of it as the storage block of this binding.
  void bind_storage(std::uint32_t binding) const;

 private:
  using Object::Object;
};

}  // namespace gpu_shading::gl
