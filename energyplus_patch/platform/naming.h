#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/error_line.h"

namespace gpu_shading::energyplus {

// Returns the result of `action`. The message of an Error, or of a failed call of the file system,
// is prefixed with the name of what it is about: "WHAT: message".
template <typename Action>
auto naming(std::string_view what, Action const& action) {
  try {
    return action();
  } catch (Error const& error) {
    throw Error(fmt::format("{}: {}", what, error.what()));
  } catch (std::filesystem::filesystem_error const& error) {
    throw Error(fmt::format("{}: {}", what, error_line(error)));
  }
}

}  // namespace gpu_shading::energyplus
