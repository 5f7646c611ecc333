#include "base/error_line.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <new>

#include "base/text.h"

namespace gpu_shading::energyplus {
namespace {

std::terminate_handler usual_end = nullptr;

void end() {
  auto const thrown = std::current_exception();
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (std::bad_alloc const& error) {
    std::fprintf(stderr, "gpu_shading: error: %s\n", error_line(error).c_str());
    _exit(EXIT_FAILURE);
  } catch (...) {  // NOLINT(bugprone-empty-catch): the usual end says what it was
  }
  usual_end();
}

}  // namespace

void catch_lack_of_memory() { usual_end = std::set_terminate(end); }

std::string error_line(std::exception const& error) {
  if (dynamic_cast<std::bad_alloc const*>(&error) == nullptr) return one_line(error.what());
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
