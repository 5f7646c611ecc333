#version 450 core
// Counts the pixels of each identity from 1 on in every layer: a run of a row per invocation.

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2DArray identities;
layout(std430, binding = 0) buffer Counts { uint counts[]; };

layout(location = 0) uniform uint most;  // the largest identity

const int run = 64;  // pixels

void main() {
  ivec2 side = textureSize(identities, 0).xy;
  int begin = run * int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  if (begin >= side.x || y >= side.y) return;
  int layer = int(gl_GlobalInvocationID.z);
  int end = min(begin + run, side.x);
  uint last = 0;
  uint count = 0;
  for (int x = begin; x < end; ++x) {
    uint identity = texelFetch(identities, ivec3(x, y, layer), 0).r;
    if (identity == last) {
      ++count;
      continue;
    }
    if (last > 0) atomicAdd(counts[uint(layer) * most + last - 1], count);
    last = identity;
    count = 1;
  }
  if (last > 0) atomicAdd(counts[uint(layer) * most + last - 1], count);
}
