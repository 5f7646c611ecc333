#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/texture.h"

namespace gpu_shading::gl {

// Asynchronous read-back of the pixels of a texture's layers.
class Readback {
 public:
  enum class Way {
    when_asked,  // if device memory is the CPU's own
    ahead,       // copied by the device right after drawing, so that nothing waits
  };

  // Reads layers of a texture, which must outlive it.
  Readback(LayeredTexture const& texture, Way way);

  static std::size_t bytes(LayeredTexture const& texture, Way way);

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
