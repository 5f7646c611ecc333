#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "gl/buffer.h"
#include "gl/object.h"

namespace gpu_shading::gl {

void destroy_texture(std::uint32_t name);

// Square layers of one 32-bit float each pixel, with as many mipmap levels as halve without a rest,
// or the first alone.
class LayeredTexture : public Object<destroy_texture> {
 public:
  enum class Levels { one, all };

  LayeredTexture() = default;
  // Throws DeviceError when there is no memory for it.
  static LayeredTexture create(int side, int layers, Levels levels);

  int side() const { return side_; }
  int layers() const { return layers_; }
  int levels() const { return levels_; }

  void bind(std::uint32_t unit) const;
  void make_mipmaps() const;
  // The first `layers` layers of a level into a buffer, from `offset` bytes on.
  void copy_level(int level, int layers, Buffer const& buffer, std::size_t offset) const;
  // All pixels of the first `layers` layers. Waits for the draws.
  void read(int layers, std::span<float> pixels) const;

 private:
  using Object::Object;

  int side_ = 0;
  int layers_ = 0;
  int levels_ = 1;
};

// Layers of one 16-bit value each texel, 0 .. 1, interpolated bilinearly.
class ValueTexture : public Object<destroy_texture> {
 public:
  ValueTexture() = default;
  // Throws DeviceError when there is no memory for it.
  static ValueTexture create(int width, int height, int layers);

  // All texels of a layer, row after row.
  void set(int layer, std::span<std::uint16_t const> texels);
  void bind(std::uint32_t unit) const;

 private:
  using Object::Object;

  int width_ = 0;
  int height_ = 0;
};

}  // namespace gpu_shading::gl
