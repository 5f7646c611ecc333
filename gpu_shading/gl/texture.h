#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "gl/buffer.h"
#include "gl/object.h"

namespace gpu_shading::gl {

void destroy_texture(std::uint32_t name);

// What a texture keeps of a pixel.
enum class Pixel {
  unit,      // 0 .. 1 in 8 bits
  real,      // a 32-bit float
  reals,     // four of them
  identity,  // an unsigned integer of 32 bits
  depth,     // a 32-bit float
  stencil,   // 8 bits
};

std::size_t size_of(Pixel pixel);  // bytes

// Square layers of pixels, with as many mipmap levels as halve without a rest, or the first alone.
class LayeredTexture : public Object<destroy_texture> {
 public:
  enum class Levels { one, all };

  LayeredTexture() = default;
  // Throws DeviceError when there is no memory for it.
  static LayeredTexture create(Pixel pixel, int side, int layers, Levels levels = Levels::one);

  Pixel pixel() const { return pixel_; }
  int side() const { return side_; }
  int layers() const { return layers_; }
  int levels() const { return levels_; }
  std::size_t layer_size(int level) const;  // bytes

  void bind(std::uint32_t unit) const;
  void make_mipmaps() const;
  // The first `layers` layers of a level into a buffer.
  void copy(int level, int layers, Buffer const& buffer) const;
  // All pixels of a layer of a level. Waits for the draws.
  void read(int level, int layer, std::span<std::byte> pixels) const;

 private:
  using Object::Object;

  Pixel pixel_ = Pixel::unit;
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
