#pragma once

namespace gpu_shading {

// Between two values. Unlike glm::mix, a (1 - part) + b part, exact where they are equal.
inline float mix(float a, float b, float part) { return a + part * (b - a); }

}  // namespace gpu_shading
