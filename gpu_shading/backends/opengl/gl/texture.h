#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/object.h"

namespace gpu_shading::gl {

void destroy_texture(std::uint32_t name);

// The pixel format of a texture.
enum class Pixel {
  unit,      // 0 .. 1 in 8 bits
  real,      // a 32-bit float
  reals,     // four of them
  identity,  // an unsigned integer of 32 bits
  depth,     // a 32-bit float
  stencil,   // 8 bits
};

std::size_t size_of(Pixel pixel);  // bytes

// Square layers of pixels.
class LayeredTexture : public Object<destroy_texture> {
 public:
  LayeredTexture() = default;
  // Throws DeviceError if there is not enough memory.
  static LayeredTexture create(Pixel pixel, int side, int layers);

  Pixel pixel() const { return pixel_; }
  int side() const { return side_; }
  int layers() const { return layers_; }
  std::size_t layer_size() const;  // bytes

  void bind(std::uint32_t unit) const;
  // Copies the first `layers` layers to a buffer.
  void copy(int layers, Buffer const& buffer) const;
  // Reads all pixels of a layer. Waits for the draws.
  void read(int layer, std::span<std::byte> pixels) const;

 private:
  using Object::Object;

  Pixel pixel_ = Pixel::unit;
  int side_ = 0;
  int layers_ = 0;
};

// Layers with one 16-bit value per texel, 0 .. 1, interpolated bilinearly.
class ValueTexture : public Object<destroy_texture> {
 public:
  ValueTexture() = default;
  // Throws DeviceError if there is not enough memory.
  static ValueTexture create(int width, int height, int layers);

  // Sets all texels of a layer, row after row.
  void set(int layer, std::span<std::uint16_t const> texels);
  void bind(std::uint32_t unit) const;

 private:
  using Object::Object;

  int width_ = 0;
  int height_ = 0;
};

}  // namespace gpu_shading::gl
