#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"
#include "routes/patched/binary/preserving_thunk.h"
#include "routes/patched/binary/symbol_table.h"

namespace gpu_shading::energyplus {

// A function to redirect to ours.
struct EntryPatch {
  char const* name;           // mangled name
  void* ours;                 // same signature
  void** original = nullptr;  // receives the trampoline to the original, if that still runs
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

std::vector<std::string_view> names_of(std::vector<EntryPatch> const& entries);

// Why entries cannot be redirected, a line for each that begins with a line break: one must be
// present, long enough and unchanged in memory, and its first instructions must be relocatable if
// the original still runs.
std::string problems_of(SymbolTable const& symbols, std::vector<EntryPatch> const& entries);

// The error that names these problems.
Error cannot_redirect(SymbolTable const& symbols, std::string const& problems);

// Redirects all entries to ours, or none. No page is writable and executable at once. No code of
// the library may run during the call. Throws cannot_redirect(), if there are problems.
void patch_entries(SymbolTable const& symbols, std::vector<EntryPatch> const& entries);

}  // namespace gpu_shading::energyplus
