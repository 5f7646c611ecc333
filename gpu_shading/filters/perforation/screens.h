#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading {

// The scene's perforated surfaces, numbered from 0 in its order.
class Screens {
 public:
  // Convex and counterclockwise; a triangle has its last corner twice.
  struct Quadrilateral {
    std::array<glm::dvec3, 4> corners;
    std::array<glm::dvec2, 4> places;  // in the tile's axes, m
  };

  struct Entry {
    std::shared_ptr<PerforatedScreen const> screen;
    glm::dvec3 normal{0.0};
    glm::dvec3 u{0.0};  // the tile's axes
    glm::dvec3 v{0.0};
    double inside = 0.0;  // the sheet's faces along the normal from the polygon, m
    double outside = 0.0;
    int deployment = -1;
    std::vector<Quadrilateral> parts;  // that make up the polygon
  };

  explicit Screens(Scene const& scene);

  static constexpr int none = -1;
  int number(SurfaceId id) const { return numbers_[id]; }
  std::vector<Entry> const& entries() const { return entries_; }
  Entry const& operator[](int number) const { return entries_[static_cast<std::size_t>(number)]; }

 private:
  std::vector<int> numbers_;
  std::vector<Entry> entries_;
};

}  // namespace gpu_shading
