#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/renderer.h"
#include "gpu_shading_answers.h"

namespace gpu_shading::energyplus {

// Of surfaces alone: all are opaque and cast shadows, and the sun may light both faces of each.
class OpaqueCalculation : public answers::Calculation {
 public:
  OpaqueCalculation(unsigned size, answers::Log log);

  unsigned add(answers::PlainSurface surface) override;
  int add_mirrored(unsigned /*original*/) override { return -1; }
  void start(answers::Simulation simulation) override;
  void set_time(int /*hour*/, int /*timestep*/) override {}
  void set_sun(double azimuth, double altitude) override { sun_ = {azimuth, altitude}; }
  float sunlit_area(unsigned surface) override;
  std::vector<float> sunlit_areas(std::vector<unsigned> const& surfaces) override;
  std::vector<float> interior_areas(unsigned window,
                                    std::vector<unsigned> const& interiors) override;
  double ray_transmittance(answers::DaylightRay const& /*ray*/) override { return 1.0; }
  void begin_daylighting() override {}
  std::string vendor() override;
  void finish() override {}

 private:
  using Direction = std::pair<double, double>;      // azimuth, altitude
  using Areas = std::vector<std::optional<float>>;  // by surface

  Renderer& renderer();
  RendererOptions options() const;
  void check(unsigned surface) const;  // throws Error unless it was there at start()
  SurfaceId lit_face(unsigned surface) const;
  void render(std::vector<unsigned> const& wanted, Areas& areas);
  Areas& known_areas();

  unsigned size_;
  answers::Log log_;
  std::vector<Surface> surfaces_;
  std::vector<glm::dvec3> normals_;
  std::optional<Renderer> renderer_;
  SunDirection sun_;
  std::vector<bool> asked_;           // by surface
  std::map<Direction, Areas> known_;  // the same days come again
};

}  // namespace gpu_shading::energyplus
