#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "answers/sun_questions.h"
#include "calculation/pv_loss.h"
#include "calculation/reflected_irradiance.h"
#include "calculation/shade_control.h"
#include "calculation/shading_calculation.h"
#include "calculation/sky_multipliers.h"
#include "calculation/step_error.h"
#include "hidden/daylight_memory.h"
#include "hidden/hidden_obstructions.h"
#include "model/model_reader.h"
#include "reports/position_record.h"
#include "reports/run_record.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// The shading calculation of a model that was read: with its transmittances, screens, schedules and
// rules, and with surroundings and shading surfaces that EnergyPlus does not see. Placeholders have
// an id, but no surface in the scene.
class Session : public ShadingCalculation {
 public:
  explicit Session(Model model) : scene_(std::move(model)) {}

  SurfaceId add(Surface surface) override;
  std::size_t size() const override { return added_.size(); }
  bool wants_mirrored() const override;
  SurfaceId add_mirrored(SurfaceId original) override;

  Surface const& surface(SurfaceId id) const;

  // Whether a surface stands in EnergyPlus's input only for others, or is the copy of one that
  // does.
  bool is_placeholder(SurfaceId id) const { return std::holds_alternative<Surface>(added_[id]); }

  ShadingInput const& input() const { return scene_.model().shading; }
  // Whether the model was changed so that EnergyPlus follows the sky's shading.
  bool follows_sky() const { return scene_.model().lean.follows_sky; }

  // Ids of EnergyPlus's shading surfaces, placeholders too, without mirrored copies, in order.
  std::vector<SurfaceId> shading_surfaces() const;

  // Reads the optics of all surfaces, and opens the device.
  void start(Simulation simulation) override;

  // Instead of start(): the surfaces with their optics, for a task (tasks/perform_task.h).
  SceneAssembly& complete(Schedules schedules);

  // Whether the days of the run are wanted; then they are handed over as they begin. Beam and wind
  // are asked for if they are needed.
  bool records_days() const {
    return record_ || control_ || pv_loss_ || scene_.optics().has_schedules();
  }
  void begin_day(RunDay const& day, RunRecord::Beam const& beam, RunRecord::Beam const& wind);

  void set_time(Moment moment) override;
  // EnergyPlus has the shading of this time.
  void end_time();
  void set_sun(SunDirection sun) override;

  // Renders the directions that EnergyPlus is expected to ask for next in the same batch.
  double projected_sunlit_area(SurfaceId receiver) override;
  std::vector<double> projected_sunlit_areas(std::span<SurfaceId const> receivers) override;

  // Only the max_back_surfaces largest are non-zero.
  std::vector<double> interior_areas(SurfaceId window,
                                     std::vector<SurfaceId> const& interiors) override;

  double daylight_transmittance(Ray const& ray, int hour) override;
  void begin_daylighting() override;

  // What need not be computed again for daylighting.
  DaylightMemory& daylight_memory() { return daylight_memory_; }
  // Whether the transmittance of surfaces for a ray of daylighting depends on a schedule.
  bool daylight_varies() const {
    return scene_.optics().has_schedules() || scene_.hides_moving_shades();
  }

  // For Options::weighs_sky_patches(): SkyMultipliers::at() with the shades as they are now, by
  // EnergyPlus's id; negative for placeholders.
  std::vector<double> sky_multipliers(SkyWeather const& weather);

  // Whether the model's receivers of reflected light get all of it from here.
  bool reflects_light() const { return !scene_.model().reflected_light.receivers.empty(); }
  // At the beginning of each timestep: the reflectance of the own ground of each of them, in the
  // model's order; empty while nothing lights the ground.
  std::vector<double> ground_reflectances(ReflectedIrradiance::Time const& time);

  // Whether the light on receivers is recorded, and the names of these.
  bool records_light() const { return record_.has_value(); }
  std::vector<std::string> recorded_receivers() const;
  // At the end of each timestep: what EnergyPlus gave them, in this order.
  void note_diffuse(int hour, std::vector<DiffuseLight> light);

  std::string vendor() override;

  void fail() override { failed_ = true; }

  // Also writes the report, unless the run has failed.
  void finish() override;

 private:
  SurfaceId in_scene(SurfaceId id) const;
  SunQuestions& answers();
  void write_reports(AnswerErrors const& errors);
  void describe_step_error();
  std::string describe_time() const;
  void read_schedules();
  void move_shades(std::optional<SunDirection> sun);
  // A value of the day, at this timestep.
  double now(std::vector<double>& day, RunRecord::Beam const& of_day) const;
  void add_outputs(Simulation const& simulation);
  void add_reflected_outputs(Simulation const& simulation);
  double rendered_area(SurfaceId id);
  void stand(std::vector<double> const& positions);
  // Calls it at each of the positions around those of this time, with its weight.
  template <typename Function>
  void interpolate(Function const& function);
  double with_pv_loss(SurfaceId id, double projected_area);
  double of_drawn(SurfaceId id, double projected_area) const;

  SceneAssembly scene_;
  // By EnergyPlus's id: the id in the scene, or a placeholder.
  std::vector<std::variant<SurfaceId, Surface>> added_;
  Messages messages_;
  std::function<double()> latitude_;  // of the site, radians
  Moment moment_;
  bool failed_ = false;
  std::optional<SunQuestions> answers_;  // once started
  std::optional<RunRecord> record_;      // for the report, or ReflectedLight::undimmed
  std::optional<ShadeControl> control_;  // of moving shades
  std::optional<StepError> step_error_;
  std::optional<PvLoss> pv_loss_;  // with --gpu-shading-pv
  std::optional<SkyMultipliers> sky_multipliers_;
  std::optional<ReflectedIrradiance> reflected_;
  std::vector<Reflected> reflected_now_;  // by receiver: what outputs show
  // Where the moving shades are between steps: the beam is interpolated.
  std::vector<WeightedPositions> corners_;
  SunDirection sun_;
  bool sky_patch_ = false;  // the sun is a patch of the sky
  bool undecided_ = false;  // the control waits for the sun of this timestep
  // Values of EnergyPlus's output variables, by moving shade.
  struct ShadeOutput {
    double position = 0.0;
    double state = 0.0;
  };
  std::vector<ShadeOutput> outputs_;
  PositionRecord position_record_;
  RunDay day_;
  RunRecord::Beam beam_of_day_;
  RunRecord::Beam wind_of_day_;
  std::vector<double> beam_;  // of the day, once asked for
  std::vector<double> wind_;  // the same
  DaylightMemory daylight_memory_;
  std::optional<HiddenObstructions> obstructions_;  // once asked for
};

}  // namespace gpu_shading::energyplus
