#pragma once

#include <functional>
#include <optional>
#include <string>

#include "binary/symbol_table.h"

// EnergyPlus's own types, only ever passed by reference.
namespace EnergyPlus {
struct EnergyPlusData;
class InputOutputFile;
}  // namespace EnergyPlus

namespace gpu_shading::energyplus {

using State = EnergyPlus::EnergyPlusData;

// The functions of EnergyPlus that we call, found by name.
class EnergyPlusFunctions {
 public:
  EnergyPlusFunctions() = default;
  // Throws Error with the list of what the build lacks.
  explicit EnergyPlusFunctions(SymbolTable const& symbols);

  // Ends the run as EnergyPlus does: a fatal message, then its own exception.
  [[noreturn]] void fatal(State& state, std::string const& message) const;
  void warning(State& state, std::string const& message) const;
  void text(State& state, std::string const& message) const;

 private:
  using File = std::optional<std::reference_wrapper<EnergyPlus::InputOutputFile>>;
  using ShowFatalError = void(State&, std::string const&, File, File);
  using Issue = void(State*, char const*);

  ShowFatalError* show_fatal_ = nullptr;
  Issue* issue_warning_ = nullptr;
  Issue* issue_text_ = nullptr;
};

}  // namespace gpu_shading::energyplus
