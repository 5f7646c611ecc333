#version 450 core
// slide.vert for pictures: the same place, and the surface that it belongs to.

layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in int surface;

// The view, per instance.
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 8) in vec4 origin_high;
layout(location = 9) in vec4 origin_low;

flat out int identity;

void main() {
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  gl_Position = vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
                     dot(row_z.xyz, p) + row_z.w, 1.0);
  identity = surface + 1;
}
