#pragma once

#include <string>

#include "binary/symbol_table.h"

namespace gpu_shading::energyplus {

// Looks functions up and remembers which a build lacks, so that all are named at once.
class FunctionFinder {
 public:
  explicit FunctionFinder(SymbolTable const& symbols) : symbols_(symbols) {}

  // Leaves `function` as it is where the build lacks it.
  template <typename Function>
  void find(std::string const& name, Function*& function) {
    if (auto* const address = look_up(name)) function = reinterpret_cast<Function*>(address);
  }

  // Throws Error with the list of what is missing, if anything is.
  void check() const;

 private:
  std::byte* look_up(std::string const& name);

  SymbolTable const& symbols_;
  std::string missing_;
};

}  // namespace gpu_shading::energyplus
