#version 450 core
// Key to add and transmittance to multiply by; blending does both.

flat in vec4 weight;
out vec4 fragment;

void main() { fragment = weight; }
