#version 450 core
// A corner of a perforated sheet at both of its faces, each to its place in a view as by slide.vert.

layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in vec2 corner;  // m in the sheet's plane
layout(location = 3) in uint screen;

layout(std140, binding = 0) uniform View {
  vec4 row_x;
  vec4 row_y;
  vec4 row_z;
  vec4 cut;
  vec4 origin_high;
  vec4 origin_low;
};

struct Face {
  vec4 normal_inside;         // unit normal; the inside face along it from the polygon, m
  vec4 shift_outside_unused;  // the way of a ray towards the sun from the inside face to the
                              // outside, m in the sheet's plane; the outside face
};
layout(std430, binding = 2) readonly buffer Faces { Face faces[]; };

out Corner {
  vec4 inside;
  vec4 outside;
  vec2 place;  // m in the sheet's plane
  vec2 shift;
  float kept;
  flat uint screen;
}
result;

vec4 slid(vec3 p) {
  return vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
              dot(row_z.xyz, p) + row_z.w, 1.0);
}

void main() {
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  Face face = faces[screen];
  vec3 normal = face.normal_inside.xyz;
  result.inside = slid(p + face.normal_inside.w * normal);
  result.outside = slid(p + face.shift_outside_unused.z * normal);
  result.place = corner;
  result.shift = face.shift_outside_unused.xy;
  // The sheet is cut where its polygon is.
  result.kept = dot(cut.xyz, p) + cut.w;
  result.screen = screen;
  gl_Position = result.inside;
}
