#version 450 core
// Stencil, depth and sample counts are all that is wanted.

void main() {}
