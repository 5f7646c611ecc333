#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/sun_position.h"
#include "reports/run_record.h"
#include "routes/patched/binary/symbol_table.h"

// EnergyPlus's own types, always passed by reference.
namespace EnergyPlus {
struct EnergyPlusData;
class InputOutputFile;
}  // namespace EnergyPlus

namespace gpu_shading::energyplus {

using State = EnergyPlus::EnergyPlusData;

// Its Vector3<double>, with the same layout.
struct Vector {
  double x, y, z;

  bool operator==(Vector const&) const = default;
};

inline glm::dvec3 to_glm(Vector const& vector) { return {vector.x, vector.y, vector.z}; }

// The signature of EnergyPlus's functions that write a message to its .err file and up to two other
// files.
using OtherFile = std::optional<std::reference_wrapper<EnergyPlus::InputOutputFile>>;
using ShowFunction = void(State&, std::string const&, OtherFile, OtherFile);

// The functions of EnergyPlus that we call, looked up by name.
class EnergyPlusFunctions {
 public:
  EnergyPlusFunctions() = default;
  // Throws Error with the list of functions that the build lacks.
  explicit EnergyPlusFunctions(SymbolTable const& symbols);

  // Ends the run as EnergyPlus does: a fatal message, then its own exception.
  [[noreturn]] void fatal(State& state, std::string const& message) const;
  void warning(State& state, std::string const& message) const;
  void text(State& state, std::string const& message) const;

  // Latitude of the site in radians, as in EnergyPlus: from the weather file, or from Site:Location
  // without one.
  double latitude(State const& state) const;

  // The day that EnergyPlus is at, without its beam; nothing if the build lacks a function for it.
  std::optional<RunDay> day(State& state) const;
  // The beam of that day (RunDay::beam).
  std::vector<double> beam_of_day(State& state) const;

  // Whether the sun is up in the weather of the timestep that EnergyPlus is at; nothing if the
  // build lacks the function for it.
  std::optional<bool> sun_in_weather(State& state) const;

 private:
  // Direction cosines of the sun: east, north, up.
  struct Cosines {
    double x, y, z;
  };
  using SunCosines = void(State const&, double hour, double equation_of_time,
                          double sine_of_declination, double cosine_of_declination, Cosines&);

  ShowFunction* show_fatal_ = nullptr;
  ShowFunction* show_message_ = nullptr;
  void (*issue_warning_)(State*, char const*) = nullptr;
  SunCosines* sun_cosines_ = nullptr;

  // Whether the sun is above the horizon, at a time in hours of a day.
  bool sun_is_up(State const& state, SunOfTime const& day, double hour) const;

  // Functions of EnergyPlus's C API, which some builds may lack.
  struct Calendar {
    using Number = int(State*);
    Number* kind = nullptr;
    Number* environment = nullptr;
    Number* month = nullptr;
    Number* day_of_month = nullptr;
    Number* day_of_year = nullptr;
    Number* is_warm_up = nullptr;
    Number* steps_per_hour = nullptr;
    double (*beam)(State*, int hour, int timestep) = nullptr;  // hours from 0, timesteps from 1

    bool complete() const {
      return kind != nullptr && environment != nullptr && month != nullptr &&
             day_of_month != nullptr && day_of_year != nullptr && is_warm_up != nullptr &&
             steps_per_hour != nullptr && beam != nullptr;
    }
  };
  Calendar calendar_;
  int (*sun_in_weather_)(State*) = nullptr;
};

}  // namespace gpu_shading::energyplus
