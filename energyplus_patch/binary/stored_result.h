#pragma once

#include <cstdint>
#include <optional>

#include "binary/symbol_table.h"

namespace gpu_shading::energyplus {

// Where a function keeps the results of another in an array, as a path of pointers from an object
// that it holds in a register: element i lies at  *(*(object + outer) + inner) + 4 i.
struct StoredResult {
  std::int64_t outer = 0;
  std::int64_t inner = 0;
};

// Reads the path out of the code of `caller`: what becomes of the 32-bit result of its last call of
// `callee`. Empty where the code does not look like that.
std::optional<StoredResult> find_stored_result(Symbol const& caller, Symbol const& callee);

}  // namespace gpu_shading::energyplus
