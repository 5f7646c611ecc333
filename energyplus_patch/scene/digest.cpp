#include "scene/digest.h"

#include <fmt/format.h>

namespace gpu_shading::energyplus {

std::string to_text(Hash const& hash) {
  std::string digits;
  for (auto const byte : hash) digits += fmt::format("{:02x}", byte);
  return digits;
}

}  // namespace gpu_shading::energyplus
