#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/renderer.h"
#include "routes/opengl/queries/boundary_answers.h"

namespace gpu_shading::energyplus {

// Answers from the triangles alone, as EnergyPlus's own pixel counting does: every surface is
// opaque and casts shadows, for nothing else is known of it, and has two sides.
class RenderedModel : public BoundaryAnswers {
 public:
  explicit RenderedModel(RendererOptions options);

  void set_model(std::span<glm::vec3 const> vertices,
                 std::span<DrawnRange const> surfaces) override;
  double sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) override;
  std::vector<double> interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                     std::vector<std::size_t> const& interiors) override;

 private:
  using Towards = std::array<double, 3>;            // the sun: x, y, z
  using Areas = std::vector<std::optional<float>>;  // by surface

  // The polygons of surfaces, all turned the same way, as the renderer wants them.
  struct Side {
    std::vector<std::vector<Polygon>> polygons;  // by surface: what it consists of
    std::vector<std::vector<SurfaceId>> parts;   // the same in the renderer's scene
    std::optional<Renderer> renderer;            // once needed
  };

  Side& side_towards(glm::dvec3 const& sun, std::size_t surface);
  void render(glm::dvec3 const& towards_sun, std::size_t surface, Areas& areas);

  RendererOptions options_;
  Side front_;  // as the triangles are turned
  Side back_;
  std::vector<bool> asked_;         // by surface
  std::map<Towards, Areas> known_;  // the same days come again
};

}  // namespace gpu_shading::energyplus
