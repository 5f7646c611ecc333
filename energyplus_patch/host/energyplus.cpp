#include "host/energyplus.h"

#include <fmt/format.h>

#include <cstdlib>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// Of a function that writes a message, by its own name with its length before it.
std::string show_name(char const* function) {
  return fmt::format(
      "_ZN10EnergyPlus{}ERNS_14EnergyPlusDataERKNSt7__cxx1112basic_stringIcSt11char_"
      "traitsIcESaIcEEESt8optionalISt17reference_wrapperINS_15InputOutputFileEEESE_",
      function);
}

template <typename Function>
Function* find(SymbolTable const& symbols, std::string const& name, std::string& missing) {
  Symbol const* const symbol = symbols.find(name);
  if (symbol == nullptr) {
    missing += fmt::format("\n  {}", name);
    return nullptr;
  }
  return reinterpret_cast<Function*>(symbol->address);
}

}  // namespace

EnergyPlusFunctions::EnergyPlusFunctions(SymbolTable const& symbols) {
  std::string missing;
  show_fatal_ = find<ShowFunction>(symbols, show_name("14ShowFatalError"), missing);
  show_message_ = find<ShowFunction>(symbols, show_name("11ShowMessage"), missing);
  issue_warning_ = find<void(State*, char const*)>(symbols, "issueWarning", missing);
  if (!missing.empty()) {
    throw Error(
        fmt::format("{}: functions are not in this build:{}", symbols.library().string(), missing));
  }
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
