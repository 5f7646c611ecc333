#include "host/energyplus.h"

#include <fmt/format.h>

#include <cstdlib>

#include "binary/function_finder.h"

namespace gpu_shading::energyplus {
namespace {

// Of a function that writes a message, by its own name with its length before it.
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

}  // namespace gpu_shading::energyplus
