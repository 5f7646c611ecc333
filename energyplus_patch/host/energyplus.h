#pragma once

#include <functional>
#include <optional>
#include <string>

#include "binary/symbol_table.h"

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
};

}  // namespace gpu_shading::energyplus
