#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>

#include "gpu_shading/device.h"
#include "gpu_shading/image.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// The scale of a picture.
struct ViewScale {
  double pixels_per_metre = 0.0;  // across the view
  double north_right = 0.0;       // of a metre to the north, pixels to the right
  double north_up = 0.0;
  // Of a point, multiplied with its coordinates and 1: pixels from the left edge, and from the top.
  glm::dvec4 across{0.0};
  glm::dvec4 down{0.0};
};

// Draws a whole scene as the sun sees it, or from elsewhere with shadows, in parallel projection
// along its rays with world-up up, on the CPU or with OpenGL. Every function throws DeviceError if
// the device fails.
class SceneView {
 public:
  // Draws the surfaces `shown` of a scene, which must outlive this object. Those that transmit are
  // see-through.
  SceneView(Scene const& scene, std::span<SurfaceId const> shown, DeviceChoice const& device);
  ~SceneView();
  SceneView(SceneView const&) = delete;
  SceneView& operator=(SceneView const&) = delete;

  // Widens the frame of all pictures to these points.
  void include(std::span<glm::dvec3 const> points);

  // `fractions`: one entry per surface of the scene. Receivers have their sunlit fraction, 0 .. 1,
  // and are drawn in fraction_colour(); other surfaces have none and are grey by their tilt to the
  // sun. The picture frames the receivers and surfaces near them, up to three times the receivers'
  // size, and cuts off no tree within seven times. `size` is the number of pixels on its longer
  // side. Throws Error if there is no receiver, or if the size is out of range
  // (1 .. DeviceInfo::max_resolution).
  Image draw(SunDirection sun, std::span<std::optional<double> const> fractions, int size);

  // The same from the direction of `camera`, also an azimuth and an altitude. Shaded parts are
  // darker; receivers that face away from the sun are slate grey, and others
  // sand-coloured. Shadows come from a picture of 3,000 pixels a side, and illustrate.
  Image draw(SunDirection camera, SunDirection sun,
             std::span<std::optional<double> const> fractions, int size);
  ViewScale scale(SunDirection camera, std::span<std::optional<double> const> fractions,
                  int size) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gpu_shading
