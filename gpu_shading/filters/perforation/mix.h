#pragma once

namespace gpu_shading {

// Interpolates between two values. Unlike glm::mix, a (1 - part) + b part, it is exact if they are
// equal.
inline float mix(float a, float b, float part) { return a + part * (b - a); }

}  // namespace gpu_shading
