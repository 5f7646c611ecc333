#include "gl/texture.h"

#include <epoxy/gl.h>

#include "gl/check.h"

namespace gpu_shading::gl {

void destroy_texture(std::uint32_t name) { glDeleteTextures(1, &name); }

LayeredTexture LayeredTexture::create(int side, int layers, Levels levels) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  LayeredTexture texture(name);
  texture.side_ = side;
  texture.layers_ = layers;
  for (int halved = side; levels == Levels::all && halved % 2 == 0; halved /= 2) ++texture.levels_;
  glTextureStorage3D(name, texture.levels_, GL_R32F, side, side, layers);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAX_LEVEL, texture.levels_ - 1);
  check("making targets for luminance");
  return texture;
}

void LayeredTexture::bind(std::uint32_t unit) const { glBindTextureUnit(unit, name()); }

void LayeredTexture::make_mipmaps() const { glGenerateTextureMipmap(name()); }

void LayeredTexture::copy_level(int level, int layers, Buffer const& buffer,
                                std::size_t offset) const {
  GLsizei const across = side_ >> level;
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  // GL takes the offset into the bound buffer as a pointer.
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  auto* const place = reinterpret_cast<void*>(offset);
  auto const bytes = static_cast<std::size_t>(across) * static_cast<std::size_t>(across) *
                     static_cast<std::size_t>(layers) * sizeof(float);
  glGetTextureSubImage(name(), level, 0, 0, 0, across, across, layers, GL_RED, GL_FLOAT,
                       static_cast<GLsizei>(offset + bytes), place);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void LayeredTexture::read(int layers, std::span<float> pixels) const {
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTextureSubImage(name(), 0, 0, 0, 0, side_, side_, layers, GL_RED, GL_FLOAT,
                       static_cast<GLsizei>(pixels.size_bytes()), pixels.data());
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
  check("making textures of screens");
  return texture;
}

void ValueTexture::set(int layer, std::span<std::uint16_t const> texels) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  glTextureSubImage3D(name(), 0, 0, 0, layer, width_, height_, 1, GL_RED, GL_UNSIGNED_SHORT,
                      texels.data());
  check("filling textures of screens");
}

void ValueTexture::bind(std::uint32_t unit) const { glBindTextureUnit(unit, name()); }

}  // namespace gpu_shading::gl
