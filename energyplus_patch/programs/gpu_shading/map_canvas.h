#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gpu_shading/image.h"

namespace gpu_shading::energyplus {

// An image to draw on. Positions are in pixels from the upper left corner, colours red, green and
// blue, 0 .. 255. Drawing outside of it is ignored.
class MapCanvas {
 public:
  // White. Sizes are at least 1.
  MapCanvas(int width, int height);

  // Mixes a colour into a pixel; `share` 1 replaces it.
  void mix(int x, int y, glm::dvec3 const& colour, double share);

  void fill(glm::ivec2 const& corner, glm::ivec2 const& size, glm::dvec3 const& colour);

  // The pixels whose middles are inside of an outline, by the odd-even rule.
  void area(std::vector<glm::dvec2> const& outline, glm::dvec3 const& colour);

  // With smooth edges.
  void line(glm::dvec2 const& a, glm::dvec2 const& b, double width, glm::dvec3 const& colour);

  Image const& image() const { return image_; }

 private:
  Image image_;
};

}  // namespace gpu_shading::energyplus
