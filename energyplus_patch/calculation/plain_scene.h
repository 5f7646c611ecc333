#pragma once

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "calculation/shading_calculation.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// Uses geometry only, as EnergyPlus's own pixel counting does: every surface is opaque and casts
// shadows, and the sun may light both of its faces.
class PlainScene : public ShadingCalculation {
 public:
  explicit PlainScene(RendererOptions options) : options_(std::move(options)) {}

  SurfaceId add(Surface surface) override;
  std::size_t size() const override { return surfaces_.size(); }
  bool wants_mirrored() const override { return false; }
  SurfaceId add_mirrored(SurfaceId original) override;
  void start(Simulation simulation) override;
  void set_time(Moment /*moment*/) override {}
  void set_sun(SunDirection sun) override { sun_ = sun; }
  double projected_sunlit_area(SurfaceId receiver) override;
  std::vector<double> projected_sunlit_areas(std::span<SurfaceId const> receivers) override;
  std::vector<double> interior_areas(SurfaceId window,
                                     std::vector<SurfaceId> const& interiors) override;
  double daylight_transmittance(Ray const& /*ray*/, int /*hour*/) override { return 1.0; }
  void begin_daylighting() override {}
  std::string vendor() override;
  void fail() override {}
  void finish() override {}

 private:
  enum class Side { front, back };
  using Direction = std::pair<double, double>;  // azimuth, altitude
  using Areas = std::vector<double>;            // by surface; not a number if unknown

  Side lit_side(SurfaceId surface) const;
  Renderer& renderer(Side side);
  Areas& known_areas();
  void render(Side side, Areas& areas);

  RendererOptions options_;
  std::vector<Surface> surfaces_;
  std::vector<glm::dvec3> normals_;  // of the surfaces that were there at start()
  // Of the surfaces, and of the surfaces turned over, which is rarely needed.
  std::array<std::optional<Renderer>, 2> renderers_;
  SunDirection sun_;
  std::vector<bool> asked_;           // by surface
  std::map<Direction, Areas> known_;  // the same days come again
};

}  // namespace gpu_shading::energyplus
