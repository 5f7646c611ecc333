#pragma once

#include "gl/buffer.h"
#include "gl/vertex_array.h"

namespace gpu_shading {

// Adds views as an array's instance data; `views` holds ViewRecords.
void add_view_records(gl::VertexArray& array, gl::Buffer const& views);

}  // namespace gpu_shading
