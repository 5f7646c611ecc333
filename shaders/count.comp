#version 450 core
// Counts the bits of masks, each by one work group.

layout(local_size_x = 256) in;

struct Range {
  uint first_word;
  uint words;
};
layout(std430, binding = 0) readonly buffer Ranges { Range ranges[]; };
layout(std430, binding = 3) readonly buffer Masks { uint masks[]; };
layout(std430, binding = 4) writeonly buffer Counts { uint counts[]; };

layout(location = 0) uniform uint first;  // of the counts

shared uint sums[256];

void main() {
  Range range = ranges[gl_WorkGroupID.x];
  uint sum = 0;
  for (uint i = gl_LocalInvocationID.x; i < range.words; i += 256) {
    sum += uint(bitCount(masks[range.first_word + i]));
  }
  sums[gl_LocalInvocationID.x] = sum;
  barrier();
  for (uint half_size = 128; half_size > 0; half_size /= 2) {
    if (gl_LocalInvocationID.x < half_size) {
      sums[gl_LocalInvocationID.x] += sums[gl_LocalInvocationID.x + half_size];
    }
    barrier();
  }
  if (gl_LocalInvocationID.x == 0) counts[first + gl_WorkGroupID.x] = sums[0];
}
