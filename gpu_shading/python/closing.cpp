#include <atomic>

#include "python/guard.h"

namespace gpu_shading::python {
namespace {

std::atomic<int> running = 0;
std::atomic<bool> closing = false;

}  // namespace

Running::Running() { ++running; }

Running::~Running() {
  --running;
  running.notify_all();
}

bool is_closed() { return closing; }

void gpu_shading_close() {
  closing = true;
  for (int left = running; left != 0; left = running) running.wait(left);
}

}  // namespace gpu_shading::python
