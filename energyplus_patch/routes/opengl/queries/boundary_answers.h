#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace gpu_shading::energyplus {

// Vertices that are drawn together: the triangles of one surface.
struct DrawnRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  std::uint32_t end() const { return first + count; }
  bool operator==(DrawnRange const&) const = default;
  bool operator<(DrawnRange const& other) const {
    return first != other.first ? first < other.first : count < other.count;
  }
};

// Answers what EnergyPlus's pixel counting asks by OpenGL. Areas are in m2 normal to the beam.
// Functions throw gpu_shading::Error.
class BoundaryAnswers {
 public:
  BoundaryAnswers() = default;
  virtual ~BoundaryAnswers() = default;
  BoundaryAnswers(BoundaryAnswers const&) = delete;
  BoundaryAnswers& operator=(BoundaryAnswers const&) = delete;
  BoundaryAnswers(BoundaryAnswers&&) = delete;
  BoundaryAnswers& operator=(BoundaryAnswers&&) = delete;

  // The model, before the first question: the triangles of all surfaces, in metres, and the
  // vertices of each surface, in order. Surfaces are numbered by their place there.
  virtual void set_model(std::span<glm::vec3 const> vertices,
                         std::span<DrawnRange const> surfaces) = 0;

  virtual double sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) = 0;

  // Of interior surfaces, in order: what the sun lights through a window.
  virtual std::vector<double> interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                             std::vector<std::size_t> const& interiors) = 0;
};

}  // namespace gpu_shading::energyplus
