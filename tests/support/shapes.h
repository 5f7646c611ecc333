#pragma once

#include <span>

#include "gpu_shading/renderer.h"
#include "support/degree.h"

// Shapes for test cases. x east, y north, z up, metres; facades face south unless stated otherwise.
namespace gpu_shading {

inline SunDirection sun_at(double azimuth_degrees, double altitude_degrees) {
  return {azimuth_degrees * degree, altitude_degrees * degree};
}

// The corner and the two edges from it; its outside is along a x b.
inline Polygon parallelogram(glm::dvec3 const& corner, glm::dvec3 const& a, glm::dvec3 const& b) {
  return {{corner, corner + a, corner + a + b, corner + b}, {}};
}

// A rectangle in the plane y, facing south.
inline Polygon south_facing(double x, double y, double z, double width, double height) {
  return parallelogram({x, y, z}, {width, 0, 0}, {0, 0, height});
}

// A rectangle in the plane z, facing up.
inline Polygon level(double x, double y, double z, double width, double depth) {
  return parallelogram({x, y, z}, {width, 0, 0}, {0, depth, 0});
}

inline Sunlit sunlit(Renderer& renderer, SunDirection sun, SurfaceId receiver) {
  return renderer.projected_sunlit_areas(sun, std::span<SurfaceId const>(&receiver, 1)).front();
}

// Rasterised by OpenGL, on the first device, where misuse of OpenGL is an error; and on the CPU.
inline constexpr DeviceChoice by_opengl{numbered_device(0), true};
inline constexpr DeviceChoice on_cpu{DeviceId{}};

inline Renderer renderer_of(Scene scene, int resolution = 512, DeviceChoice device = {}) {
  RendererOptions options;
  options.resolution = resolution;
  options.samples_only = true;
  options.device = device;
  return Renderer(std::move(scene), options);
}

}  // namespace gpu_shading
