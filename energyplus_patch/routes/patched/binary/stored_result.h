#pragma once

#include <cstdint>
#include <optional>

#include "routes/patched/binary/symbol_table.h"

namespace gpu_shading::energyplus {

// Where a function stores the results of another in an array, as a path of pointers from an object
// that it holds in a register: element i is at  *(*(object + outer) + inner) + 4 i.
struct StoredResult {
  std::int64_t outer = 0;
  std::int64_t inner = 0;
};

// Reads the path from the code of `caller`, which stores the 32-bit result of its last call of
// `callee`. Empty if the code does not have this form.
std::optional<StoredResult> find_stored_result(Symbol const& caller, Symbol const& callee);

}  // namespace gpu_shading::energyplus
