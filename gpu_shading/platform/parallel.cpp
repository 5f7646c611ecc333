#include "platform/parallel.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "gpu_shading/device.h"
#include "gpu_shading/error.h"

namespace gpu_shading {

bool lacks_threads() {
  static pid_t const first = getpid();
  return getpid() != first;
}

int available_threads() {
  if (lacks_threads()) return 1;
  auto const allowed =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(allowed));
}

void limit_threads(int count) {
  if (count < 1) throw Error(fmt::format("{} threads: expected 1 or more", count));
  static std::unique_ptr<tbb::global_control> limit;
  // The smallest of several limits holds.
  limit.reset();
  limit =
      std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count);
}

}  // namespace gpu_shading
