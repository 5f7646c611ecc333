#version 450 core
// Adds up the sums of a layer's squares, one layer per work group, always in the same order.

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Sums { float sums[]; };
layout(std430, binding = 1) writeonly buffer Totals { double totals[]; };

layout(location = 0) uniform uint of_a_layer;

shared double parts[256];

void main() {
  uint lane = gl_LocalInvocationID.x;
  double part = 0.0lf;
  for (uint i = lane; i < of_a_layer; i += 256) {
    part += double(sums[gl_WorkGroupID.x * of_a_layer + i]);
  }
  parts[lane] = part;
  barrier();
  for (uint some = 128; some > 0; some /= 2) {
    if (lane < some) parts[lane] += parts[lane + some];
    barrier();
  }
  if (lane == 0) totals[gl_WorkGroupID.x] = parts[0];
}
