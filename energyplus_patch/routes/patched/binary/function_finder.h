#pragma once

#include <initializer_list>
#include <string>

#include "routes/patched/binary/symbol_table.h"

namespace gpu_shading::energyplus {

// Looks up functions and collects those that a build lacks, so that all are reported at once.
class FunctionFinder {
 public:
  explicit FunctionFinder(SymbolTable const& symbols) : symbols_(symbols) {}

  // Leaves `function` unchanged if the build lacks it.
  template <typename Function>
  void find(std::string const& name, Function*& function) {
    if (auto* const address = look_up(name)) function = reinterpret_cast<Function*>(address);
  }

  // The first of these names that the build has, for functions whose signature has changed.
  template <typename Function>
  void find_any(std::initializer_list<char const*> names, Function*& function) {
    for (auto const* const name : names) {
      if (symbols_.find(name) != nullptr) return find(name, function);
    }
    find(*names.begin(), function);
  }

  // Throws Error with the list of missing functions, if any.
  void check() const;

 private:
  std::byte* look_up(std::string const& name);

  SymbolTable const& symbols_;
  std::string missing_;
};

}  // namespace gpu_shading::energyplus
