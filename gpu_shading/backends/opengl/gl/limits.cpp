#include "backends/opengl/gl/limits.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "backends/opengl/gl/check.h"
#include "gpu_shading/error.h"

namespace gpu_shading::gl {
namespace {

std::string text(GLenum which) {
  auto const* const found = reinterpret_cast<char const*>(glGetString(which));
  return found == nullptr ? "" : found;
}

int integer(GLenum which) {
  GLint value = 0;
  glGetIntegerv(which, &value);
  return value;
}

std::size_t max_storage_bytes() {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  return static_cast<std::size_t>(most);
}

}  // namespace

Limits query_limits() {
  Limits limits;
  limits.renderer = text(GL_RENDERER);
  limits.vendor = text(GL_VENDOR);
  limits.version = text(GL_VERSION);
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  limits.max_texture_size = integer(GL_MAX_TEXTURE_SIZE);
  // Targets are textures or renderbuffers.
  limits.max_target_size = std::min({viewport[0], viewport[1], integer(GL_MAX_RENDERBUFFER_SIZE),
                                     integer(GL_MAX_FRAMEBUFFER_WIDTH),
                                     integer(GL_MAX_FRAMEBUFFER_HEIGHT), limits.max_texture_size});
  limits.max_layers =
      std::min(integer(GL_MAX_ARRAY_TEXTURE_LAYERS), integer(GL_MAX_FRAMEBUFFER_LAYERS));
  limits.storage_bytes = max_storage_bytes();
  limits.vertex_storage_blocks = integer(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS);
  limits.layers_in_vertex_stage = epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array");
  check("asking for the device's limits");
  return limits;
}

void require_vertex_storage(char const* content) {
  if (query_limits().vertex_storage_blocks >= 1) return;
  throw DeviceError(
      fmt::format("the device has no storage buffers in its vertex stage, which {} need; choose "
                  "another (gpu_shading devices), or cpu",
                  content));
}

void require_storage(std::size_t bytes, char const* content) {
  std::size_t const most = max_storage_bytes();
  if (bytes <= most) return;
  constexpr double mib = 1024.0 * 1024.0;
  throw DeviceError(fmt::format(
      "{}: {} take a storage block of {:.0f} MiB, more than the device's limit of {:.0f} MiB; use "
      "the device cpu",
      text(GL_RENDERER), content, static_cast<double>(bytes) / mib,
      static_cast<double>(most) / mib));
}

}  // namespace gpu_shading::gl
