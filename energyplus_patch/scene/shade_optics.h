#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/model_reader.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

// The optics of shading surfaces: GPUShading:TransparentShade or :PerforatedScreen, times the
// surface's own Transmittance Schedule. A transmittance schedule with one constant value is treated
// as a number, so that the renderer has less to count separately; if an EMS or a program overrides
// it, it becomes a factor.
class ShadeOptics {
 public:
  ShadeOptics() = default;
  // Throws Error, naming object and field, if EnergyPlus lacks a schedule.
  ShadeOptics(Model const& model, Schedules schedules);

  // Glass is opaque to long-wave radiation; what passes other shades is as for the sun.
  enum class Radiation { solar, light, long_wave };

  // Sets a surface's casting and filter. `texture`: of a mesh.
  // Throws Error if a screen's texture cannot be read.
  void apply(Surface& surface, std::optional<TextureAxes> const& texture = std::nullopt,
             Radiation radiation = Radiation::solar) const;

  // Reads the schedules. Returns true if one that was treated as a number has another value: optics
  // must then be applied again.
  bool update(Moment moment);

  // What update() would set at another time.
  std::vector<double> factors_at(Moment moment) const;
  std::vector<double> deployments_at(Moment moment) const;

  // Whether a surface has a Transmittance, Deployment or Leaf Schedule, even a constant one.
  bool has_schedules() const { return !by_name_.empty() || !deployment_names_.empty(); }

  Schedules const& schedules() const { return schedules_; }

  // Indexed by the numbers that apply() assigns.
  std::vector<double> const& factors() const { return factors_; }
  std::vector<std::string> const& factor_names() const { return factor_names_; }
  std::vector<double> const& deployments() const { return deployments_; }
  std::vector<std::string> const& deployment_names() const { return deployment_names_; }

 private:
  struct Schedule {
    std::optional<double> held;  // the number that replaces it
    int factor = -1;             // else
  };

  // A schedule's range; `field`: the object's, which errors about the schedule name from now on.
  std::pair<double, double> range_for(std::string const& name, std::string const& object,
                                      std::string_view field);
  double value(std::string const& name, Moment moment) const;
  void add_transmittance_schedules();
  void add_deployments();
  void add_leaf_schedules();
  void add_deployment(std::string const& name, double most);
  // Its position in deployments(); -1 if it is none of them.
  int deployment_of(std::string const& schedule) const;
  void make_factor(std::string const& name, Schedule& schedule);
  void apply_screen(Surface& surface, std::optional<TextureAxes> const& texture) const;

  Model const* model_ = nullptr;
  Schedules schedules_;
  std::map<std::string, std::string> fields_;  // "OBJECT: FIELD" that names a schedule first
  std::map<std::string, Schedule> by_name_;
  std::vector<std::string> factor_names_;
  std::vector<double> factors_;
  std::vector<std::string> deployment_names_;
  std::vector<double> deployments_;
  // Transmittances multiplied by constant schedules, created once so that surfaces share them.
  mutable std::map<std::pair<Transmittance const*, double>, std::shared_ptr<Transmittance const>>
      products_;
};

// "transparent (construction Double)", "opaque", ..., for listings. Throws Error if a screen's
// texture cannot be read.
std::string describe_optics(Model const& model, Surface const& surface,
                            std::optional<TextureAxes> const& texture = std::nullopt);

}  // namespace gpu_shading::energyplus
