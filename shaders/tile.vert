#version 450 core
#extension GL_ARB_shader_viewport_layer_array : enable
// Draws a receiver on its own tile, at the far end: the same pixels at every sun direction.

layout(location = 0) in vec2 place;
layout(location = 1) in int layer;

void main() {
  gl_Position = vec4(place, 1.0, 1.0);
#ifdef GL_ARB_shader_viewport_layer_array
  gl_Layer = layer;
#endif
}
