#include "host/energyplus.h"

#include <fmt/format.h>

#include <cstdlib>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

constexpr char const* show_fatal_name =
    "_ZN10EnergyPlus14ShowFatalErrorERNS_14EnergyPlusDataERKNSt7__cxx1112basic_stringIcSt11char_"
    "traitsIcESaIcEEESt8optionalISt17reference_wrapperINS_15InputOutputFileEEESE_";

template <typename Function>
Function* find(SymbolTable const& symbols, char const* name, std::string& missing) {
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
  show_fatal_ = find<ShowFatalError>(symbols, show_fatal_name, missing);
  issue_warning_ = find<Issue>(symbols, "issueWarning", missing);
  issue_text_ = find<Issue>(symbols, "issueText", missing);
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
  issue_text_(&state, message.c_str());
}

}  // namespace gpu_shading::energyplus
