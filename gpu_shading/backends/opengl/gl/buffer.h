#pragma once

#include <array>
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

  // Allocates this many bytes for the device alone, in place of what it had.
  void set_size(std::size_t bytes);
  // Sets the first bytes to 0.
  void clear(std::size_t bytes);
  void copy_to(Buffer& to, std::size_t bytes) const;

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

// The contents of a shader storage block, which change between submissions. Draws under way keep
// theirs: NVIDIA's driver (580.159) writes new data over what earlier draws still read from a
// storage block, whatever the memory barriers.
class StorageBuffer {
 public:
  // Submissions that may be under way when the contents are replaced.
  static constexpr std::size_t max_in_flight = 3;

  // Replaces the contents; at most once for each submission.
  template <typename T>
  void set(std::span<T const> values) {
    turn_ = (turn_ + 1) % buffers_.size();
    Buffer& buffer = buffers_[turn_];
    if (buffer.empty()) buffer = Buffer::create();
    buffer.set(values);
  }

  void bind(std::uint32_t binding) const { buffers_[turn_].bind_storage(binding); }

 private:
  std::array<Buffer, max_in_flight + 1> buffers_;  // each once it is needed
  std::size_t turn_ = 0;
};

}  // namespace gpu_shading::gl
