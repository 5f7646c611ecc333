#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/model_reader.h"
#include "session/schedules.h"

namespace gpu_shading::energyplus {

// What shading surfaces let through: GPUShading:TransparentShade or :PerforatedScreen, times the
// surface's own Transmittance Schedule. A transmittance schedule of one value all the simulation
// long is taken for a number, so that the renderer has less to keep apart; where an EMS or a
// program overrides it all the same, it becomes a factor.
class ShadeOptics {
 public:
  ShadeOptics() = default;
  // Throws Error, naming object and field, where EnergyPlus lacks a schedule.
  ShadeOptics(Model const& model, Schedules schedules);

  // Sets a surface's casting, transmittance, schedule, screen and deployment. `texture`: of a
  // mesh. Throws Error where a screen's texture cannot be read.
  void apply(Surface& surface, std::optional<TextureAxes> const& texture = std::nullopt) const;

  // Reads the schedules. True where one that was taken for a number has another value: optics have
  // to be applied anew.
  bool update(Moment moment);

  // By the numbers that apply() gives out.
  std::vector<double> const& factors() const { return factors_; }
  std::vector<std::string> const& factor_names() const { return factor_names_; }
  std::vector<double> const& deployments() const { return deployments_; }
  std::vector<std::string> const& deployment_names() const { return deployment_names_; }

 private:
  struct Schedule {
    std::optional<double> held;  // the number it is taken for
    int factor = -1;             // else
  };

  void add_transmittance_schedules();
  void add_deployments();
  void make_factor(std::string const& name, Schedule& schedule);
  void apply_screen(Surface& surface, std::optional<TextureAxes> const& texture) const;

  Model const* model_ = nullptr;
  Schedules schedules_;
  std::map<std::string, Schedule> by_name_;
  std::vector<std::string> factor_names_;
  std::vector<double> factors_;
  std::vector<std::string> deployment_names_;
  std::vector<double> deployments_;
  // What schedules of one value make of transmittances: made once, so that surfaces share it.
  mutable std::map<std::pair<Transmittance const*, double>, std::shared_ptr<Transmittance const>>
      products_;
};

// "transparent (construction Double)", "opaque", ...: for listings. Throws Error where a screen's
// texture cannot be read.
std::string describe_optics(Model const& model, Surface const& surface,
                            std::optional<TextureAxes> const& texture = std::nullopt);

}  // namespace gpu_shading::energyplus
