#version 450 core

layout(location = 0) uniform uint identity;

out uint fragment;

void main() { fragment = identity; }
