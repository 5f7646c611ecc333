#version 450 core
// Outputs the key to add and the transmittance to multiply by; blending does both.

flat in vec4 weight;
out vec4 fragment;

void main() { fragment = weight; }
