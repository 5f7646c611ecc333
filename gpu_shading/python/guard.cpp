#include "python/guard.h"

#include <atomic>

#include "gpu_shading/device.h"

namespace gpu_shading::python {
namespace {

std::atomic<int> running = 0;
std::atomic<bool> closing = false;

}  // namespace

std::string& message() {
  thread_local std::string last;
  return last;
}

Running::Running() { ++running; }

Running::~Running() {
  --running;
  running.notify_all();
}

bool is_closed() { return closing; }

char const* gpu_shading_message() { return message().c_str(); }

char const* gpu_shading_version() { return GPU_SHADING_VERSION; }

int gpu_shading_limit_threads(int count) {
  return guarded([&] { limit_threads(count); });
}

void gpu_shading_close() {
  closing = true;
  for (int left = running; left != 0; left = running) running.wait(left);
}

}  // namespace gpu_shading::python
