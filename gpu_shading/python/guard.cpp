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

// From the last function on this thread that failed, or that says that it leaves text here.
GPU_SHADING_CALL char const* gpu_shading_message() { return message().c_str(); }

GPU_SHADING_CALL char const* gpu_shading_version() { return GPU_SHADING_VERSION; }

GPU_SHADING_CALL int gpu_shading_limit_threads(int count) {
  return guarded([&] { limit_threads(count); });
}

// Waits until no function runs on any thread; from now on they return `closed`. A process that ends
// meanwhile would destroy what they use. A single call of gpu_shading_rays_... stops early.
GPU_SHADING_CALL void gpu_shading_close() {
  closing = true;
  for (int left = running; left != 0; left = running) running.wait(left);
}

}  // namespace gpu_shading::python
