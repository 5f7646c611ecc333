#version 450 core
// A point of the scene to its place in a parallel projection, with the surface that it belongs to.

layout(location = 0) in vec3 point;
layout(location = 1) in uint surface;

layout(location = 0) uniform vec4 row_x;
layout(location = 1) uniform vec4 row_y;
layout(location = 2) uniform vec4 row_z;

flat out uint identity;

void main() {
  gl_Position = vec4(dot(row_x.xyz, point) + row_x.w, dot(row_y.xyz, point) + row_y.w,
                     dot(row_z.xyz, point) + row_z.w, 1.0);
  identity = surface;
}
