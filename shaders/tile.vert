#version 450 core
// A receiver on its own tile: the same pixels at every direction of the sun.

layout(location = 0) in vec2 place;

void main() { gl_Position = vec4(place, 0.5, 1.0); }
