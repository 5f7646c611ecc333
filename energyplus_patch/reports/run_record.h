#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

// A day that EnergyPlus begins to simulate.
struct RunDay {
  enum class Kind { design_day, run_period, other };

  Kind kind = Kind::other;
  int environment = 0;
  int month = 0;
  int day = 0;
  bool warm_up = false;
  int steps_per_hour = 1;
};

// Light on a receiver that is not beam, W/m2.
struct DiffuseLight {
  double sky = 0.0;        // of the sky, straight from it
  double by_ground = 0.0;  // reflected, on paths on which the ground reflects
  double by_shades = 0.0;  // reflected by shades, neighbours and the building alone
};

// Energy of each kind of light on a receiver, kWh/m2, by month and, with `hours` 24, by hour of the
// day; both from 0.
class ReceivedLight {
 public:
  enum Kind : std::size_t { beam, sky, by_ground, by_shades };
  static constexpr std::size_t kinds = 4;
  static constexpr std::size_t months = 12;

  // `hours`: 24 or 1.
  explicit ReceivedLight(std::size_t hours) : hours_(hours), energy_(kinds * months * hours) {}

  std::size_t hours() const { return hours_; }
  // Without hours, that of the month is at hour 0.
  double at(Kind kind, std::size_t month, std::size_t hour) const {
    return energy_[(kind * months + month) * hours_ + hour];
  }
  void add(Kind kind, std::size_t month, std::size_t hour, double energy) {
    energy_[(kind * months + month) * hours_ + (hours_ > 1 ? hour : 0)] += energy;
  }
  double of_month(Kind kind, std::size_t month) const;
  double of_run(Kind kind) const;

 private:
  std::size_t hours_;
  std::vector<double> energy_;
};

// The sunlit fractions that EnergyPlus was given, by day and hour, and the light on receivers: the
// beam solar energy that they make of the weather, as EnergyPlus multiplies the same numbers, and
// what EnergyPlus says of the rest. Of the run periods, or of the design days where there are no
// others.
class RunRecord {
 public:
  struct Hour {
    int hour = 0;  // 1 .. 24
    SunDirection sun;
    std::vector<float> fractions;  // by receiver; negative where the sun is behind it
    // Direct normal irradiance, W/m2: the mean over the days that were simulated with these
    // answers.
    double beam = 0.0;
    // As begin_step() was given them.
    std::vector<float> shares = {};
  };
  // The hours during all of which the sun faces a receiver, and before and after them, as
  // scripts/compare_shading takes them (results.py): the others' hourly fractions count timesteps
  // with the sun behind the receiver as 0.
  struct WholeHours {
    float sum = 0.0F;  // of their mean sunlit fractions
    int count = 0;
  };
  struct Day {
    int month = 0;
    int day = 0;
    std::vector<Hour> hours;        // with the sun up, at their last timestep
    std::vector<WholeHours> whole;  // by receiver
  };

  // `areas`: unit normal x net area (m2), by surface.
  RunRecord(std::vector<glm::dvec3> areas, std::vector<SurfaceId> receivers);

  // What EnergyPlus says, in its order: a day begins; a timestep of it, whose sun and answers hold
  // for this day and those that follow, until others are given; the sun; m2 normal to its beam.
  // `shares`: how far shades are deployed or leaved at this timestep, and their transmittance
  // schedules, 0 .. 1.
  // The direct normal irradiance, W/m2, at every timestep of a day is asked for where it counts.
  // A day may begin again at each of its timesteps.
  using Beam = std::function<std::vector<double>()>;
  void begin_day(RunDay const& day, Beam const& beam);
  void begin_step(Moment moment, std::vector<float> shares = {});
  void set_sun(SunDirection sun);
  void note(SurfaceId receiver, double projected_area);
  // At an hour of the day, 1 .. 24, for one timestep; by receiver.
  void note_diffuse(int hour, std::vector<DiffuseLight> const& light);
  void end();

  std::vector<SurfaceId> const& receivers() const { return receivers_; }
  // Its place among the receivers.
  std::optional<std::size_t> place_of(SurfaceId surface) const { return places_[surface]; }
  // Days with answers of their own. Some are left out where they would take too much memory.
  std::vector<Day> const& days() const { return kept().days; }
  bool of_design_days() const { return run_period_.simulated == 0; }
  // The days that EnergyPlus simulated, without warm-up.
  std::size_t simulated() const { return kept().simulated; }
  // The days among them of each month, January first.
  std::array<int, ReceivedLight::months> const& days_of_months() const {
    return kept().days_of_months;
  }
  // By receiver, after end(). Without hours where they would take too much memory.
  std::vector<ReceivedLight> const& light() const { return kept().light; }
  // Whether light that is not beam was noted.
  bool has_diffuse() const { return kept().has_diffuse; }

 private:
  struct Step {
    std::optional<SunDirection> sun;
    std::vector<float> fractions;
    std::vector<float> shares;
  };
  struct Period {
    std::vector<Day> days;
    std::size_t values = 0;  // in `days`
    std::size_t stride = 1;  // one of so many days is kept
    std::size_t offered = 0;
    std::size_t simulated = 0;
    std::array<int, ReceivedLight::months> days_of_months{};
    std::vector<ReceivedLight> light;
    bool has_diffuse = false;
    std::size_t last = 0;  // among `days`: whose answers hold
    // Of the days that these held for, by hour.
    std::array<double, 24> normal_beam{};
    int beam_days = 0;
  };

  Period& period() { return day_->kind == RunDay::Kind::run_period ? run_period_ : design_days_; }
  Period const& kept() const { return of_design_days() ? design_days_ : run_period_; }
  // Whether this day is of the run.
  bool counts() const;
  void make_room(Period& period) const;
  void end_day();
  void add_beam();
  void add_normal_beam();
  static void share_beam(Period& period);
  void keep_day();
  bool is_faced(std::size_t receiver, std::size_t step) const;
  WholeHours whole_hours(std::size_t receiver) const;

  std::vector<glm::dvec3> areas_;
  std::vector<SurfaceId> receivers_;
  std::vector<std::optional<std::size_t>> places_;  // among receivers_, by surface
  std::optional<RunDay> day_;
  std::vector<double> beam_;  // of the day
  std::vector<Step> steps_;
  bool has_new_steps_ = false;
  Step* step_ = nullptr;  // being answered
  glm::dvec3 towards_sun_{0.0, 0.0, 1.0};
  Period run_period_;
  Period design_days_;
};

}  // namespace gpu_shading::energyplus
