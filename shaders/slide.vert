#version 450 core
#extension GL_ARB_shader_viewport_layer_array : enable
// Transforms a point of the scene to its position in a view: an affine map of the point relative to
// the view's origin, and the distance to the view's clip plane.

layout(location = 0) in vec3 high;  // the double coordinate, rounded
layout(location = 1) in vec3 low;   // and what rounding left

// The view, per instance.
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 cut;  // kept where dot(cut.xyz, p) + cut.w >= 0
layout(location = 8) in vec4 origin_high;
layout(location = 9) in vec4 origin_low;
layout(location = 10) in ivec4 numbers;  // layer of the target; identity of what is drawn

// As in transmit.vert: both programs must cover the same pixels, up to the same plane.
invariant gl_Position;

flat out int identity;

void main() {
  // Near the view's origin, the first difference is exact, and the second adds what single
  // precision dropped.
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  gl_Position = vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
                     dot(row_z.xyz, p) + row_z.w, 1.0);
  precise float kept = dot(cut.xyz, p) + cut.w;
  gl_ClipDistance[0] = kept;
  identity = numbers.y;
#ifdef GL_ARB_shader_viewport_layer_array
  gl_Layer = numbers.x;
#endif
}
