#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "binary/symbol_table.h"

namespace gpu_shading::energyplus {

// A function to redirect to ours.
struct EntryPatch {
  char const* name;           // mangled name
  void* ours;                 // same signature
  void** original = nullptr;  // receives the trampoline to the original, if that still runs
  bool needed = true;         // if false, it is skipped where the library lacks it
};

// An entry whose original still runs, through `original`.
template <typename Function>
EntryPatch watch(char const* name, Function* ours, Function** original) {
  return {name, reinterpret_cast<void*>(ours), reinterpret_cast<void**>(original)};
}

// Throws Error if patch_entries would fail.
void check_entries(SymbolTable const& symbols, std::vector<EntryPatch> const& entries);

// Redirects all entries to ours, or none. First it checks that each one is present, long enough and
// unchanged in memory, and that its first instructions can be relocated if the original still runs.
// No page is writable and executable at once. No code of the library may run during the call.
// Throws Error with a line for each entry that fails.
void patch_entries(SymbolTable const& symbols, std::vector<EntryPatch> const& entries);

}  // namespace gpu_shading::energyplus
