#pragma once

#include <string>

namespace gpu_shading::gl {

// What the current context is and can do.
struct Limits {
  std::string renderer;
  std::string vendor;
  std::string version;
  int max_target_size = 0;           // pixels a side of a framebuffer
  int max_texture_size = 0;          // texels a side
  int uniform_offset_alignment = 1;  // bytes
  int vertex_storage_blocks = 0;     // OpenGL promises none
};

Limits query_limits();

}  // namespace gpu_shading::gl
