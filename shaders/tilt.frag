#version 450 core
// Grey by the tilt of the face to the sun: light where it faces the sun, dark where it is edge-on.

layout(location = 0) uniform vec4 sun;

in vec3 position;
out vec4 fragment;

void main() {
  vec3 across = cross(dFdx(position), dFdy(position));
  float facing = abs(dot(across, sun.xyz)) / max(length(across), 1e-30);
  fragment = vec4(vec3(mix(0.25, 0.85, facing)), 1.0);
}
