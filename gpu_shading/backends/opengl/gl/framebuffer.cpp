#include "backends/opengl/gl/framebuffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "backends/opengl/gl/check.h"
#include "gpu_shading/error.h"

namespace gpu_shading::gl {
namespace {

GLenum internal_format(Format format) {
  switch (format) {
    case Format::depth_stencil:
      return GL_DEPTH32F_STENCIL8;
    case Format::identity:
      return GL_R32UI;
    case Format::colour:
      break;
  }
  return GL_RGBA8;
}

GLenum attachment(Format format) {
  return format == Format::depth_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_COLOR_ATTACHMENT0;
}

GLenum attachment(Pixel pixel) {
  switch (pixel) {
    case Pixel::depth:
      return GL_DEPTH_ATTACHMENT;
    case Pixel::stencil:
      return GL_STENCIL_ATTACHMENT;
    case Pixel::unit:
    case Pixel::real:
    case Pixel::reals:
    case Pixel::identity:
      break;
  }
  return GL_COLOR_ATTACHMENT0;
}

}  // namespace

void destroy_renderbuffer(std::uint32_t name) { glDeleteRenderbuffers(1, &name); }
void destroy_framebuffer(std::uint32_t name) { glDeleteFramebuffers(1, &name); }

Renderbuffer Renderbuffer::create(Format format, int width, int height) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  glNamedRenderbufferStorage(name, internal_format(format), width, height);
  return Renderbuffer(name);
}

Framebuffer Framebuffer::create(std::vector<Format> const& formats, int width, int height) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer target(name);
  target.width_ = width;
  target.height_ = height;
  for (Format const format : formats) {
    Renderbuffer const& buffer =
        target.attachments_.emplace_back(Renderbuffer::create(format, width, height));
    glNamedFramebufferRenderbuffer(name, attachment(format), GL_RENDERBUFFER, buffer.name());
  }
  target.check_complete();
  return target;
}

Framebuffer Framebuffer::of_layers(std::initializer_list<LayeredTexture const*> textures) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer target(name);
  bool coloured = false;
  for (LayeredTexture const* const texture : textures) {
    GLenum const place = attachment(texture->pixel());
    coloured = coloured || place == GL_COLOR_ATTACHMENT0;
    target.width_ = target.height_ = texture->side();
    glNamedFramebufferTexture(name, place, texture->name(), 0);
  }
  if (!coloured) {
    glNamedFramebufferDrawBuffer(name, GL_NONE);
    glNamedFramebufferReadBuffer(name, GL_NONE);
  }
  target.check_complete();
  return target;
}

void Framebuffer::check_complete() const {
  check("creating an offscreen target");
  GLenum const status = glCheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw DeviceError(fmt::format(
        "the driver cannot draw to an offscreen target of {} x {} pixels (status {:#06x}); lower "
        "the resolution or choose the device 'cpu'",
        width_, height_, status));
  }
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, name());
  glViewport(0, 0, width_, height_);
}

void Framebuffer::unbind() { glBindFramebuffer(GL_FRAMEBUFFER, 0); }

void Framebuffer::clear_stencil() const {
  GLint const zero = 0;
  glClearNamedFramebufferiv(name(), GL_STENCIL, 0, &zero);
}

void Framebuffer::clear_depth(float depth) const {
  // Like draws, it respects the write mask.
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(name(), GL_DEPTH, 0, &depth);
}

void Framebuffer::clear_colour(glm::vec4 const& colour) const {
  glClearNamedFramebufferfv(name(), GL_COLOR, 0, &colour.x);
}

void Framebuffer::clear_identity() const {
  GLuint const none[4] = {0, 0, 0, 0};
  glClearNamedFramebufferuiv(name(), GL_COLOR, 0, none);
}

std::size_t Framebuffer::pixels() const {
  return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

std::vector<std::uint8_t> Framebuffer::read_colour() const {
  std::vector<std::uint8_t> colours(4 * pixels());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, colours.data());
  check("reading a picture back");
  return colours;
}

std::vector<std::uint32_t> Framebuffer::read_identity() const {
  std::vector<std::uint32_t> identities(pixels());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name());
  glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, identities.data());
  check("reading surfaces back");
  return identities;
}

}  // namespace gpu_shading::gl
