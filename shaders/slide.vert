#version 450 core
// A point of the scene to its place in a view: an affine map of the point relative to the view's
// origin, and the distance to the plane at which the view cuts.

layout(location = 0) in vec3 high;  // the double coordinate, rounded
layout(location = 1) in vec3 low;   // and what rounding left

layout(std140, binding = 0) uniform View {
  vec4 row_x;
  vec4 row_y;
  vec4 row_z;
  vec4 cut;  // kept where dot(cut.xyz, p) + cut.w >= 0
  vec4 origin_high;
  vec4 origin_low;
};

// Drawn twice in the interior pass and compared for equal depth.
invariant gl_Position;

out vec3 position;

void main() {
  // Near the view's origin the first difference is exact, and the second adds what float32 dropped.
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  gl_Position = vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
                     dot(row_z.xyz, p) + row_z.w, 1.0);
  gl_ClipDistance[0] = dot(cut.xyz, p) + cut.w;
  position = p;
}
