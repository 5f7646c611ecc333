#pragma once

#include <optional>
#include <string>
#include <vector>

#include "routes/patched/binary/preserving_thunk.h"
#include "routes/patched/binary/symbol_table.h"

namespace gpu_shading::energyplus {

// A function to redirect to ours.
struct EntryPatch {
  char const* name;           // mangled name
  void* ours;                 // same signature
  void** original = nullptr;  // receives the trampoline to the original, if that still runs
  bool needed = true;         // if false, it is skipped where the library lacks it
  // Entered so that all registers but that of the result are preserved (preserve_registers); if
  // empty, `ours` looks after them itself.
  std::optional<Result> result = Result::integer;
};

// An entry whose original no longer runs.
template <typename Returned, typename... Arguments>
EntryPatch replace(char const* name, Returned (*ours)(Arguments...)) {
  EntryPatch entry{name, reinterpret_cast<void*>(ours)};
  entry.result = result_of<Returned>();
  return entry;
}

// An entry whose original still runs, through `original`.
template <typename Returned, typename... Arguments>
EntryPatch watch(char const* name, Returned (*ours)(Arguments...),
                 Returned (**original)(Arguments...)) {
  EntryPatch entry{name, reinterpret_cast<void*>(ours), reinterpret_cast<void**>(original)};
  entry.result = result_of<Returned>();
  return entry;
}

// Throws Error if patch_entries would fail.
void check_entries(SymbolTable const& symbols, std::vector<EntryPatch> const& entries);

// Redirects all entries to ours, or none. First it checks that each one is present, long enough and
// unchanged in memory, and that its first instructions can be relocated if the original still runs.
// No page is writable and executable at once. No code of the library may run during the call.
// Throws Error with a line for each entry that fails.
void patch_entries(SymbolTable const& symbols, std::vector<EntryPatch> const& entries);

}  // namespace gpu_shading::energyplus
