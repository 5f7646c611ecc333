#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gl/object.h"

namespace gpu_shading::gl {

void destroy_buffer(std::uint32_t name);

class Buffer : public Object<destroy_buffer> {
 public:
  Buffer() = default;
  static Buffer create();

  // Replaces the contents. Storage in use by earlier draws is left to them.
  void set_data(std::span<std::byte const> bytes);

  // Room for as many bytes, their values anything.
  void set_size(std::size_t bytes);

  template <typename T>
  void set(std::span<T const> values) {
    set_data(std::as_bytes(values));
  }

  // Bytes [offset, offset + size) as the uniform block of this binding.
  void bind_uniform(std::uint32_t binding, std::size_t offset, std::size_t size) const;

  // All of it as the storage block of this binding.
  void bind_storage(std::uint32_t binding) const;

  // Waits for what is being written.
  std::vector<float> read_floats(std::size_t count) const;

 private:
  using Object::Object;
};

}  // namespace gpu_shading::gl
