#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "answers/sun_answers.h"
#include "gpu_shading/scene.h"
#include "hidden/daylight_memory.h"
#include "hidden/hidden_luminance.h"
#include "hidden/hidden_obstructions.h"
#include "hidden/hidden_reflections.h"
#include "model/model_reader.h"
#include "platform/messages.h"
#include "reports/run_record.h"
#include "scene/scene_assembly.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

// The shading calculation of one EnergyPlus run, from the surfaces that it adds to the areas that
// it asks for. Ids are EnergyPlus's, which count from 0 in the order of adding; placeholders have
// one too, but no surface in the scene. Every function throws gpu_shading::Error.
class Session {
 public:
  // EnergyPlus's WindowComplexManager has room for this many lit back surfaces per window.
  static constexpr std::size_t max_back_surfaces = 20;

  explicit Session(Model model) : scene_(std::move(model)) {}

  SurfaceId add(Surface surface);
  std::size_t size() const { return added_.size(); }

  Surface const& surface(SurfaceId id) const;

  // Adds the mirrored copy of a shading surface.
  SurfaceId add_mirrored(SurfaceId original);

  // Whether a surface stands in EnergyPlus's input only for others, or is the copy of one that
  // does.
  bool is_placeholder(SurfaceId id) const { return std::holds_alternative<Surface>(added_[id]); }

  ShadingInput const& input() const { return scene_.model().shading; }

  // Ids of EnergyPlus's shading surfaces, placeholders too, without mirrored copies, in order.
  std::vector<SurfaceId> shading_surfaces() const;

  // Called when all surfaces are added: reads their optics and opens the device. `latitude`: the
  // site's, in radians; only called if sun positions are sampled.
  void start(Messages messages, Schedules schedules, std::function<double()> latitude = {});

  // Instead of start(): the surfaces with their optics, for a task (tasks/perform_task.h).
  SceneAssembly& complete(Schedules schedules);

  // Whether the report wants the days of the run; then they are handed over as they begin.
  bool records_days() const { return record_.has_value(); }
  void begin_day(RunDay const& day, RunRecord::Beam const& beam);

  // Sets the time at which schedules are evaluated from now on.
  void set_time(Moment moment);
  void set_sun(SunDirection sun);

  // m2 normal to the beam. The first call for a direction renders all receivers that were requested
  // before, together with the directions that EnergyPlus is expected to ask for next, in one batch.
  float projected_sunlit_area(SurfaceId receiver);

  // The same for interior surfaces that the sun reaches through a window, in order; only the
  // max_back_surfaces largest are non-zero.
  std::vector<float> interior_areas(SurfaceId window, std::vector<SurfaceId> const& interiors);

  // What the surfaces that EnergyPlus does not know let pass of a ray of its daylighting, 0 .. 1,
  // at an hour of the day (HiddenObstructions).
  double daylight_transmittance(Ray const& ray, int hour);

  // EnergyPlus computes daylighting for another period.
  void begin_daylighting();

  // What need not be computed again for daylighting.
  DaylightMemory& daylight_memory() { return daylight_memory_; }
  // Whether what the surfaces let pass of a ray of daylighting, EnergyPlus's too, depends on a
  // schedule.
  bool daylight_varies() const { return scene_.optics().has_schedules(); }

  // What the same surfaces do to reflected solar radiation; nullptr if there are none.
  HiddenReflections* reflections();

  // What they do to light that daylighting receives by reflection; nullptr if there are none.
  HiddenLuminance* luminance();

  // The last direction to the sun at the first timestep of an hour, 1 .. 24; nothing if EnergyPlus
  // did not ask for it.
  std::optional<glm::dvec3> first_sun(int hour) const;

  // Called at the end of the run: reports what rendered, and writes the report.
  void finish();

 private:
  SurfaceId in_scene(SurfaceId id) const;
  SunAnswers& answers();
  void write_reports();
  void renew_reflections();
  std::optional<glm::dvec3>* first_sun_now();

  SceneAssembly scene_;
  // By EnergyPlus's id: the id in the scene, or a placeholder.
  std::vector<std::variant<SurfaceId, Surface>> added_;
  Messages messages_;
  Moment moment_;
  static constexpr std::size_t hours = 24;
  std::array<std::optional<glm::dvec3>, hours> first_suns_;
  std::optional<SunAnswers> answers_;  // once started
  std::optional<RunRecord> record_;    // for the report
  DaylightMemory daylight_memory_;
  std::optional<HiddenObstructions> obstructions_;  // once asked for
  std::optional<HiddenReflections> reflections_;    // once asked for
  std::optional<HiddenLuminance> luminance_;        // once asked for
};

}  // namespace gpu_shading::energyplus
