#pragma once

#include <fmt/format.h>

#include <string_view>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

// Returns the result of `action`. The message of an Error is prefixed with the name of what it is
// about: "WHAT: message".
template <typename Action>
auto naming(std::string_view what, Action const& action) {
  try {
    return action();
  } catch (Error const& error) {
    throw Error(fmt::format("{}: {}", what, error.what()));
  }
}

}  // namespace gpu_shading::energyplus
