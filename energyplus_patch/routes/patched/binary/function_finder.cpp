#include "routes/patched/binary/function_finder.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

std::byte* FunctionFinder::look_up(std::string const& name) {
  Symbol const* const symbol = symbols_.find(name);
  if (symbol != nullptr) return symbol->address;
  missing_ += fmt::format("\n  {}", name);
  return nullptr;
}

void FunctionFinder::check() const {
  if (missing_.empty()) return;
  throw Error(
      fmt::format("{}: functions missing in this build:{}", symbols_.library().string(), missing_));
}

}  // namespace gpu_shading::energyplus
