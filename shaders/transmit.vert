#version 450 core
#extension GL_ARB_shader_viewport_layer_array : enable
// slide.vert for surfaces that transmit: the same position, and the surface's factor on the
// luminance of a pixel.

layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in int surface;

// The view, per instance.
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 cut;
layout(location = 8) in vec4 origin_high;
layout(location = 9) in vec4 origin_low;
// Keys: one per schedule; shades: one per surface, at the sun direction.
layout(location = 10) in ivec4 numbers;  // layer; first key, -1 none; first shade

struct Shade {
  float transmittance;  // 0 opaque
  int schedule;         // -1 none
  float extinction;     // of a crown
};
layout(std430, binding = 0) readonly buffer Shades { Shade shades[]; };
layout(std430, binding = 1) readonly buffer Keys { vec4 keys[]; };

// As in slide.vert: both programs must cover the same pixels, up to the same plane.
invariant gl_Position;

flat out vec4 weight;

void main() {
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  gl_Position = vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
                     dot(row_z.xyz, p) + row_z.w, 1.0);
  precise float kept = dot(cut.xyz, p) + cut.w;
  gl_ClipDistance[0] = kept;
  Shade shade = shades[numbers.z + surface];
  bool keyed = numbers.y >= 0 && shade.schedule >= 0;
  vec3 key = keyed ? keys[numbers.y + shade.schedule].rgb : vec3(0.0);
  weight = vec4(key, shade.transmittance);
#ifdef GL_ARB_shader_viewport_layer_array
  gl_Layer = numbers.x;
#endif
}
