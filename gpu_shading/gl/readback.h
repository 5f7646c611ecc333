#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/texture.h"

namespace gpu_shading::gl {

// The pixels of a texture's layers on their way to this side.
class Readback {
 public:
  enum class Way {
    when_asked,  // where device memory is the CPU's own
    ahead,       // copied by the device as soon as they are drawn, so that nothing waits
  };

  // Of layers of a level of the texture, which must outlive it.
  Readback(LayeredTexture const& texture, int level, Way way);

  static std::size_t bytes(LayeredTexture const& texture, int level, Way way);

  void start(int layers);
  // After what start() came after has been waited for; good until the next.
  template <typename T>
  std::span<T const> layer(int layer) {
    return {reinterpret_cast<T const*>(find(layer)), texture_.layer_size(level_) / sizeof(T)};
  }

 private:
  std::byte const* find(int layer);

  LayeredTexture const& texture_;
  int level_;
  Buffer buffer_;
  std::byte const* ahead_ = nullptr;
  std::vector<std::byte> asked_;
};

}  // namespace gpu_shading::gl
