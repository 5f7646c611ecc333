#include "platform/memory_use.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>

namespace gpu_shading::energyplus {

std::string describe_lack_of_memory() {
  constexpr std::uint64_t mib = std::uint64_t{1} << 20U;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  auto const used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / mib;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return fmt::format("out of memory, with {} MiB of addresses in use", used);
  }
  constexpr int least = 300;  // of small models
  return fmt::format(
      "out of memory: ulimit -v allows {} MiB of addresses, of which {} are in use; a small model "
      "needs {}",
      limit.rlim_cur / mib, used, least);
}

}  // namespace gpu_shading::energyplus
