#pragma once

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
  int vertex_storage_blocks = 0;        // OpenGL guarantees none
  bool layers_in_vertex_stage = false;  // GL_ARB_shader_viewport_layer_array
};

Limits query_limits();

}  // namespace gpu_shading::gl
