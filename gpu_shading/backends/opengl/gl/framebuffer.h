#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <vector>

#include "backends/opengl/gl/object.h"
#include "backends/opengl/gl/texture.h"

namespace gpu_shading::gl {

void destroy_renderbuffer(std::uint32_t name);
void destroy_framebuffer(std::uint32_t name);

enum class Format {
  depth_stencil,
  colour,    // RGBA of 8 bits
  identity,  // an unsigned integer
};

class Renderbuffer : public Object<destroy_renderbuffer> {
 public:
  Renderbuffer() = default;
  static Renderbuffer create(Format format, int width, int height);

 private:
  using Object::Object;
};

// An offscreen target. Single-sampled.
class Framebuffer : public Object<destroy_framebuffer> {
 public:
  Framebuffer() = default;
  // Owns its attachments. Throws DeviceError if the driver cannot draw to this target.
  static Framebuffer create(std::vector<Format> const& formats, int width, int height);

  // Attaches all layers of textures, which must outlive it: at most one each for colour, depth and
  // stencil. Draws select a layer with gl_Layer.
  static Framebuffer of_layers(std::initializer_list<LayeredTexture const*> textures);

  // Makes it the target of draws, with a viewport over all of it.
  void bind() const;
  // Ends that. Programs then find what was drawn in its textures: softpipe otherwise keeps it in a
  // cache that compute programs do not read.
  static void unbind();

  // Clears every layer.
  void clear_stencil() const;  // to 0
  void clear_depth(float depth) const;
  void clear_colour(glm::vec4 const& colour) const;
  void clear_identity() const;  // to 0

  // RGBA, 8 bits per channel, rows from the bottom. Waits for the draws.
  std::vector<std::uint8_t> read_colour() const;
  std::vector<std::uint32_t> read_identity() const;

 private:
  using Object::Object;

  void check_complete() const;
  std::size_t pixels() const;

  int width_ = 0;
  int height_ = 0;
  std::vector<Renderbuffer> attachments_;
};

}  // namespace gpu_shading::gl
