#pragma once

#include <functional>
#include <string_view>

namespace gpu_shading::energyplus {

// While it lives, this thread's EnergyPlus does not write errors and warnings for which the
// function returns true, nor the lines that continue them. One at a time.
class UnwantedMessages {
 public:
  explicit UnwantedMessages(std::function<bool(std::string_view message)> unwanted);
  ~UnwantedMessages();
  UnwantedMessages(UnwantedMessages const&) = delete;
  UnwantedMessages& operator=(UnwantedMessages const&) = delete;
};

}  // namespace gpu_shading::energyplus
