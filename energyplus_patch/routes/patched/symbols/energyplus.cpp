#include "routes/patched/symbols/energyplus.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "routes/patched/binary/function_finder.h"

namespace gpu_shading::energyplus {
namespace {

// The mangled name of a function that writes a message, from its own name with its length in front.
std::string show_name(char const* function) {
  return fmt::format(
      "_ZN10EnergyPlus{}ERNS_14EnergyPlusDataERKNSt7__cxx1112basic_stringIcSt11char_"
      "traitsIcESaIcEEESt8optionalISt17reference_wrapperINS_15InputOutputFileEEESE_",
      function);
}

}  // namespace

EnergyPlusFunctions::EnergyPlusFunctions(SymbolTable const& symbols) {
  FunctionFinder finder(symbols);
  finder.find(show_name("14ShowFatalError"), show_fatal_);
  finder.find(show_name("11ShowMessage"), show_message_);
  finder.find("issueWarning", issue_warning_);
  // Before 25.1 the state is not const.
  finder.find_any(
      {"_ZN10EnergyPlus7Weather28CalculateSunDirectionCosinesERKNS_14EnergyPlusDataEddddRN"
       "9ObjexxFCL7Vector3IdEE",
       "_ZN10EnergyPlus7Weather28CalculateSunDirectionCosinesERNS_14EnergyPlusDataEddddRN"
       "9ObjexxFCL7Vector3IdEE"},
      sun_cosines_);
  finder.check();
  FunctionFinder optional(symbols);
  optional.find("kindOfSim", calendar_.kind);
  optional.find("currentEnvironmentNum", calendar_.environment);
  optional.find("month", calendar_.month);
  optional.find("dayOfMonth", calendar_.day_of_month);
  optional.find("dayOfYear", calendar_.day_of_year);
  optional.find("warmupFlag", calendar_.is_warm_up);
  optional.find("numTimeStepsInHour", calendar_.steps_per_hour);
  optional.find("todayWeatherBeamSolarRadiationAtTime", calendar_.beam);
  optional.find("sunIsUp", sun_in_weather_);
}

void EnergyPlusFunctions::fatal(State& state, std::string const& message) const {
  show_fatal_(state, message, std::nullopt, std::nullopt);
  std::abort();  // it throws
}

void EnergyPlusFunctions::warning(State& state, std::string const& message) const {
  issue_warning_(&state, message.c_str());
}

void EnergyPlusFunctions::text(State& state, std::string const& message) const {
  show_message_(state, message, std::nullopt, std::nullopt);
}

double EnergyPlusFunctions::latitude(State const& state) const {
  // A sun at the celestial pole is as high as the latitude, in the north or in the south. If it is
  // below the horizon, EnergyPlus returns its depth alone; the same holds on the horizon, at the
  // equator.
  for (double const sine : {1.0, -1.0}) {
    Cosines pole{};
    sun_cosines_(state, 12.0, 0.0, sine, 0.0, pole);
    if (pole.y != 0.0) return sine * std::atan2(pole.z, std::abs(pole.y));
  }
  return 0.0;
}

bool EnergyPlusFunctions::sun_is_up(State const& state, SunOfTime const& day, double hour) const {
  constexpr double minutes = 60.0;
  Cosines sun{};
  sun_cosines_(state, hour, day.equation_of_time / minutes, std::sin(day.declination),
               std::cos(day.declination), sun);
  return sun.z > 0.0;
}

std::optional<RunDay> EnergyPlusFunctions::day(State& state) const {
  if (!calendar_.complete()) return std::nullopt;
  // Its enumeration of simulations.
  constexpr int design_day = 1;
  constexpr int run_period = 3;
  int const kind = calendar_.kind(&state);
  RunDay day;
  if (kind == design_day) day.kind = RunDay::Kind::design_day;
  if (kind == run_period) day.kind = RunDay::Kind::run_period;
  day.environment = calendar_.environment(&state);
  day.month = calendar_.month(&state);
  day.day = calendar_.day_of_month(&state);
  day.warm_up = calendar_.is_warm_up(&state) != 0;
  day.steps_per_hour = calendar_.steps_per_hour(&state);
  return day;
}

std::vector<double> EnergyPlusFunctions::beam_of_day(State& state) const {
  if (!calendar_.complete()) return {};
  constexpr int hours = 24;
  int const steps_per_hour = calendar_.steps_per_hour(&state);
  std::vector<double> beam;
  auto const sun = sun_of_day(calendar_.day_of_year(&state));
  for (int hour = 0; hour < hours; ++hour) {
    for (int step = 1; step <= steps_per_hour; ++step) {
      // Between hours, the weather may have a beam before sunrise, which EnergyPlus drops.
      double const end = hour + static_cast<double>(step) / steps_per_hour;
      bool const up = sun_is_up(state, sun, end);
      beam.push_back(up ? calendar_.beam(&state, hour, step) : 0.0);
    }
  }
  return beam;
}

std::optional<bool> EnergyPlusFunctions::sun_in_weather(State& state) const {
  if (sun_in_weather_ == nullptr) return std::nullopt;
  return sun_in_weather_(&state) != 0;
}

}  // namespace gpu_shading::energyplus
