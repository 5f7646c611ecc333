#include "routes/patched/symbols/energyplus.h"

#include <cmath>
#include <cstdlib>

namespace gpu_shading::energyplus {

void EnergyPlusFunctions::fatal(State& state, std::string const& message) const {
  symbol::show_fatal.in(symbols_)(state, message, std::nullopt, std::nullopt);
  std::abort();  // it throws
}

void EnergyPlusFunctions::warning(State& state, std::string const& message) const {
  symbol::issue_warning.in(symbols_)(&state, message.c_str());
}

void EnergyPlusFunctions::text(State& state, std::string const& message) const {
  symbol::show_message.in(symbols_)(state, message, std::nullopt, std::nullopt);
}

Vector EnergyPlusFunctions::sun(State const& state, double hour, double equation_of_time,
                                double sine_of_declination, double cosine_of_declination) const {
  Vector cosines{};
  if (auto const function = symbol::sun_cosines.in(symbols_)) {
    function(state, hour, equation_of_time, sine_of_declination, cosine_of_declination, cosines);
  } else {
    symbol::sun_cosines_of_mutable_state.in(symbols_)(const_cast<State&>(state), hour,
                                                      equation_of_time, sine_of_declination,
                                                      cosine_of_declination, cosines);
  }
  return cosines;
}

double EnergyPlusFunctions::latitude(State const& state) const {
  // A sun at the celestial pole is as high as the latitude, in the north or in the south. If it is
  // below the horizon, EnergyPlus returns its depth alone; the same holds on the horizon, at the
  // equator.
  for (double const sine : {1.0, -1.0}) {
    auto const pole = sun(state, 12.0, 0.0, sine, 0.0);
    if (pole.y != 0.0) return sine * std::atan2(pole.z, std::abs(pole.y));
  }
  return 0.0;
}

bool EnergyPlusFunctions::sun_is_up(State const& state, SunOfTime const& day, double hour) const {
  constexpr double minutes = 60.0;
  return sun(state, hour, day.equation_of_time / minutes, std::sin(day.declination),
             std::cos(day.declination))
             .z > 0.0;
}

RunDay EnergyPlusFunctions::day(State& state) const {
  // Its enumeration of simulations.
  constexpr int design_day = 1;
  constexpr int run_period = 3;
  int const kind = symbol::kind_of_simulation.in(symbols_)(&state);
  RunDay day;
  if (kind == design_day) day.kind = RunDay::Kind::design_day;
  if (kind == run_period) day.kind = RunDay::Kind::run_period;
  day.environment = symbol::environment_number.in(symbols_)(&state);
  day.month = symbol::month.in(symbols_)(&state);
  day.day = symbol::day_of_month.in(symbols_)(&state);
  day.warm_up = symbol::warm_up_flag.in(symbols_)(&state) != 0;
  day.steps_per_hour = symbol::steps_per_hour.in(symbols_)(&state);
  return day;
}

std::vector<double> EnergyPlusFunctions::beam_of_day(State& state) const {
  constexpr int hours = 24;
  int const steps_per_hour = symbol::steps_per_hour.in(symbols_)(&state);
  auto const weather_beam = symbol::weather_beam.in(symbols_);
  std::vector<double> beam;
  auto const sun = sun_of_day(symbol::day_of_year.in(symbols_)(&state));
  for (int hour = 0; hour < hours; ++hour) {
    for (int step = 1; step <= steps_per_hour; ++step) {
      // Between hours, the weather may have a beam before sunrise, which EnergyPlus drops.
      double const end = hour + static_cast<double>(step) / steps_per_hour;
      bool const up = sun_is_up(state, sun, end);
      beam.push_back(up ? weather_beam(&state, hour, step) : 0.0);
    }
  }
  return beam;
}

}  // namespace gpu_shading::energyplus
