#pragma once

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/vertex_array.h"

namespace gpu_shading {

// Adds views as an array's instance data; `views` holds ViewRecords.
void add_view_records(gl::VertexArray& array, gl::Buffer const& views);

}  // namespace gpu_shading
