#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "gl_boundary/boundary_answers.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// Answers from the triangles alone, as EnergyPlus's own pixel counting does: every surface is
// opaque and casts shadows, for nothing else is known of it.
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

  void render(SunDirection sun, Areas& areas);

  RendererOptions options_;
  std::optional<Renderer> renderer_;
  std::vector<std::vector<SurfaceId>> parts_;  // by surface: what it consists of in the scene
  std::vector<bool> asked_;                    // by surface
  std::map<Towards, Areas> known_;             // the same days come again
};

}  // namespace gpu_shading::energyplus
