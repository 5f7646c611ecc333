#include "backends/opengl/gl/texture.h"

#include <epoxy/gl.h>

#include "backends/opengl/gl/check.h"

namespace gpu_shading::gl {

namespace {

struct Layout {
  GLenum internal;
  GLenum format;
  GLenum type;
  std::size_t bytes;
};

Layout layout_of(Pixel pixel) {
  switch (pixel) {
    case Pixel::real:
      return {GL_R32F, GL_RED, GL_FLOAT, 4};
    case Pixel::reals:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
    case Pixel::identity:
      return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
    case Pixel::depth:
      return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4};
    case Pixel::stencil:
      return {GL_STENCIL_INDEX8, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1};
    case Pixel::unit:
      break;
  }
  return {GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1};
}

}  // namespace

void destroy_texture(std::uint32_t name) { glDeleteTextures(1, &name); }

std::size_t size_of(Pixel pixel) { return layout_of(pixel).bytes; }

LayeredTexture LayeredTexture::create(Pixel pixel, int side, int layers) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  LayeredTexture texture(name);
  texture.pixel_ = pixel;
  texture.side_ = side;
  texture.layers_ = layers;
  glTextureStorage3D(name, 1, layout_of(pixel).internal, side, side, layers);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  check("creating render targets");
  return texture;
}

std::size_t LayeredTexture::layer_size() const {
  auto const across = static_cast<std::size_t>(side_);
  return across * across * size_of(pixel_);
}

void LayeredTexture::bind(std::uint32_t unit) const { glBindTextureUnit(unit, name()); }

void LayeredTexture::copy(int layers, Buffer const& buffer) const {
  Layout const layout = layout_of(pixel_);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureSubImage(name(), 0, 0, 0, 0, side_, side_, layers, layout.format, layout.type,
                       static_cast<GLsizei>(layer_size() * static_cast<std::size_t>(layers)),
                       nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void LayeredTexture::read(int layer, std::span<std::byte> pixels) const {
  Layout const layout = layout_of(pixel_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureSubImage(name(), 0, 0, 0, layer, side_, side_, 1, layout.format, layout.type,
                       static_cast<GLsizei>(pixels.size()), pixels.data());
}

ValueTexture ValueTexture::create(int width, int height, int layers) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  ValueTexture texture(name);
  texture.width_ = width;
  texture.height_ = height;
  glTextureStorage3D(name, 1, GL_R16, width, height, layers);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  check("creating screen textures");
  return texture;
}

void ValueTexture::set(int layer, std::span<std::uint16_t const> texels) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  glTextureSubImage3D(name(), 0, 0, 0, layer, width_, height_, 1, GL_RED, GL_UNSIGNED_SHORT,
                      texels.data());
  check("uploading screen textures");
}

void ValueTexture::bind(std::uint32_t unit) const { glBindTextureUnit(unit, name()); }

}  // namespace gpu_shading::gl
