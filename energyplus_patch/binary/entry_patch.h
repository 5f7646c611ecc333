#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "binary/symbol_table.h"

namespace gpu_shading::energyplus {

// One function whose entry is to be led to ours.
struct Entry {
  char const* name;           // mangled
  void* ours;                 // same signature
  void** original = nullptr;  // where the way to the original is to be stored, if it still runs
  bool needed = true;         // else left alone where the library lacks it
};

// An entry whose original still runs, through `original`.
template <typename Function>
Entry watch(char const* name, Function* ours, Function** original) {
  return {name, reinterpret_cast<void*>(ours), reinterpret_cast<void**>(original)};
}

// Whether patch_entries can do its work; throws Error as it does.
void check_entries(SymbolTable const& symbols, std::vector<Entry> const& entries);

// Leads every entry to ours, or none: all of them are checked first (present, long enough,
// unchanged in memory, its first instructions movable where the original still runs). No page is
// writable and executable at once; nothing of the library may run meanwhile. Throws Error with a
// line for each entry that fails.
void patch_entries(SymbolTable const& symbols, std::vector<Entry> const& entries);

}  // namespace gpu_shading::energyplus
