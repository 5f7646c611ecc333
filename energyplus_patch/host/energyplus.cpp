#include "host/energyplus.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "binary/function_finder.h"

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
  finder.find(
      "_ZN10EnergyPlus7Weather28CalculateSunDirectionCosinesERKNS_14EnergyPlusDataEddddRN"
      "9ObjexxFCL7Vector3IdEE",
      sun_cosines_);
  finder.check();
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

}  // namespace gpu_shading::energyplus
