#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/object.h"
#include "gl/texture.h"

namespace gpu_shading::gl {

void destroy_renderbuffer(std::uint32_t name);
void destroy_framebuffer(std::uint32_t name);

enum class Format {
  stencil,
  depth_stencil,
  colour,          // RGBA of 8 bits
  precise_colour,  // RGBA of 32-bit floats
  identity,        // an unsigned integer
};

class Renderbuffer : public Object<destroy_renderbuffer> {
 public:
  Renderbuffer() = default;
  static Renderbuffer create(Format format, int width, int height);

 private:
  using Object::Object;
};

// An offscreen target that owns what is attached to it. Single-sampled.
class Framebuffer : public Object<destroy_framebuffer> {
 public:
  Framebuffer() = default;
  // Throws DeviceError when the driver cannot draw to this.
  static Framebuffer create(std::vector<Format> const& formats, int width, int height);

  // One layer of a texture, which must outlive it.
  static Framebuffer of_layer(LayeredTexture const& texture, int layer);

  // Draws go here, over all of it.
  void bind() const;

  void clear_stencil() const;  // to 0
  void clear_depth() const;    // to 1, the far end
  void clear_colour(glm::vec4 const& colour) const;
  void clear_identity() const;  // to 0

  // RGBA, 8 bits a channel, rows from the bottom. Waits for the draws.
  std::vector<std::uint8_t> read_colour() const;
  void read_precise_colour(std::vector<glm::vec4>& colours) const;
  std::vector<std::uint32_t> read_identity() const;

 private:
  using Object::Object;

  void check_complete() const;
  void start_reading() const;
  std::size_t pixels() const;

  int width_ = 0;
  int height_ = 0;
  std::vector<Renderbuffer> attachments_;
};

}  // namespace gpu_shading::gl
