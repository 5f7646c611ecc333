#version 450 core
// Sums squares of 64 x 64 pixels, one a group, always in the same order.

layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 0) uniform sampler2DArray luminance;
layout(std430, binding = 0) writeonly buffer Sums { float sums[]; };

layout(location = 0) uniform uint first;  // of the sums of this texture's layers

shared float part[256];

void main() {
  ivec2 side = textureSize(luminance, 0).xy;
  ivec2 corner = 64 * ivec2(gl_WorkGroupID.xy) + ivec2(gl_LocalInvocationID.xy);
  int layer = int(gl_WorkGroupID.z);
  float sum = 0.0;
  for (int y = 0; y < 64; y += 16) {
    for (int x = 0; x < 64; x += 16) {
      ivec2 place = corner + ivec2(x, y);
      if (all(lessThan(place, side))) sum += texelFetch(luminance, ivec3(place, layer), 0).r;
    }
  }
  uint index = gl_LocalInvocationIndex;
  part[index] = sum;
  barrier();
  for (uint half_of = 128u; half_of > 0u; half_of /= 2u) {
    if (index < half_of) part[index] += part[index + half_of];
    barrier();
  }
  if (index == 0u) {
    uvec3 groups = gl_NumWorkGroups;
    uint group = (gl_WorkGroupID.z * groups.y + gl_WorkGroupID.y) * groups.x + gl_WorkGroupID.x;
    sums[first + group] = part[0];
  }
}
