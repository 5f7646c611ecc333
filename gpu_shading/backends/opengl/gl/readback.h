#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/texture.h"

namespace gpu_shading::gl {

// Signals when the device has done the work submitted before its creation. Creating, querying and
// destroying it require the current context. Move-only; empty when default-constructed or moved
// from.
class Fence {
 public:
  Fence() = default;
  // Submits the work before it to the device.
  static Fence here();

  Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
  Fence& operator=(Fence&& other) noexcept {
    std::swap(sync_, other.sync_);
    return *this;
  }
  Fence(Fence const&) = delete;
  Fence& operator=(Fence const&) = delete;
  ~Fence();

  // Throws DeviceError if the device is lost.
  void wait() const;

 private:
  void* sync_ = nullptr;
};

// Asynchronous read-back of the pixels of a texture's layers.
class Readback {
 public:
  enum class Mode {
    when_asked,  // if device memory is the CPU's own
    ahead,       // copied by the device right after drawing, so that nothing waits
  };

  // Reads layers of a texture, which must outlive it.
  Readback(LayeredTexture const& texture, Mode mode);

  static std::size_t bytes(LayeredTexture const& texture, Mode mode);

  void start(int layers);
  // The pixels, once a fence after start() has been waited for; valid until the next start().
  template <typename T>
  std::span<T const> layer(int layer) {
    return {reinterpret_cast<T const*>(find(layer)), texture_.layer_size() / sizeof(T)};
  }

 private:
  std::byte const* find(int layer);

  LayeredTexture const& texture_;
  Buffer buffer_;
  std::byte const* ahead_ = nullptr;
  std::vector<std::byte> asked_;
};

}  // namespace gpu_shading::gl
