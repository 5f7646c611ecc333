#pragma once

#include <memory>
#include <optional>
#include <span>

#include "gpu_shading/device.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// Draws a whole scene as the sun sees it, a parallel projection along its rays with its head up, on
// the CPU or by OpenGL. Every function throws DeviceError when the device fails.
class SceneView {
 public:
  // `shown`: the surfaces that are drawn, of a scene that outlives this. Those that transmit are
  // see through.
  SceneView(Scene const& scene, std::span<SurfaceId const> shown, DeviceChoice const& device);
  ~SceneView();
  SceneView(SceneView const&) = delete;
  SceneView& operator=(SceneView const&) = delete;

  // `fractions`: by surface of the scene, its sunlit fraction, 0 .. 1, where it is a receiver: its
  // colour (fraction_colour); all others are grey, by their tilt to the sun. The picture is around
  // the receivers, up to twice as large as they are; `size` pixels on its longer side. Throws Error
  // where there is no receiver, or the size is out of range.
  Image draw(SunDirection sun, std::span<std::optional<double> const> fractions, int size);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// From dark blue, 0, to yellow, 1: cividis (Nunez, Anderton & Renslow 2018), which reads alike for
// all kinds of colour vision, and in grey. Red, green, blue, 0 .. 255.
glm::dvec3 fraction_colour(double fraction);

}  // namespace gpu_shading
