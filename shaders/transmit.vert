#version 450 core
// slide.vert for surfaces that let part of the sun through: the same place, and what the surface
// does to the luminance of a pixel.

layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in uint surface;

layout(std140, binding = 0) uniform View {
  vec4 row_x;
  vec4 row_y;
  vec4 row_z;
  vec4 cut;
  vec4 origin_high;
  vec4 origin_low;
};

struct Shade {
  float transmittance;  // at this direction of the sun; 0 opaque
  int schedule;         // -1 none
};
layout(std430, binding = 0) readonly buffer Shades { Shade shades[]; };
layout(std430, binding = 1) readonly buffer Keys { vec4 keys[]; };

layout(location = 0) uniform int first_key;  // of the view, one for each schedule; -1 none

// As in slide.vert: both paths cover the same pixels.
invariant gl_Position;

flat out vec4 weight;

void main() {
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  gl_Position = vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
                     dot(row_z.xyz, p) + row_z.w, 1.0);
  gl_ClipDistance[0] = dot(cut.xyz, p) + cut.w;
  Shade shade = shades[surface];
  bool keyed = first_key >= 0 && shade.schedule >= 0;
  vec3 key = keyed ? keys[first_key + shade.schedule].rgb : vec3(0.0);
  weight = vec4(key, shade.transmittance);
}
