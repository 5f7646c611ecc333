#pragma once

#include <cstddef>
#include <string>

namespace gpu_shading::gl {

// Name, version and limits of the current context.
struct Limits {
  std::string renderer;
  std::string vendor;
  std::string version;
  int max_target_size = 0;              // pixels per side of a framebuffer
  int max_texture_size = 0;             // texels per side
  int max_layers = 0;                   // of a texture
  std::size_t storage_bytes = 0;        // of a storage block
  int vertex_storage_blocks = 0;        // OpenGL guarantees none
  bool layers_in_vertex_stage = false;  // GL_ARB_shader_viewport_layer_array
};

Limits query_limits();

// Throws DeviceError if the vertex stage of the current context has no storage buffers. `content`
// names what needs them.
void require_vertex_storage(char const* content);

// Throws DeviceError if a storage block of the current context cannot have so many bytes. `content`
// names what it holds.
void require_storage(std::size_t bytes, char const* content);

}  // namespace gpu_shading::gl
