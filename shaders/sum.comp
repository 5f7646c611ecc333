#version 450 core
// Sums squares of 16 x 16 pixels, one per invocation, always in the same order.

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray luminance;
layout(std430, binding = 0) writeonly buffer Sums { float sums[]; };

void main() {
  ivec2 side = textureSize(luminance, 0).xy;
  ivec2 across = (side + 15) / 16;
  ivec2 square = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(square, across))) return;
  int layer = int(gl_GlobalInvocationID.z);
  ivec2 corner = 16 * square;
  ivec2 end = min(corner + 16, side);
  float sum = 0.0;
  for (int y = corner.y; y < end.y; ++y) {
    float row = 0.0;
    for (int x = corner.x; x < end.x; ++x) row += texelFetch(luminance, ivec3(x, y, layer), 0).r;
    sum += row;
  }
  sums[(layer * across.y + square.y) * across.x + square.x] = sum;
}
