#include "threads/parallel.h"

#include <unistd.h>

namespace gpu_shading {

bool lacks_threads() {
  static pid_t const first = getpid();
  return getpid() != first;
}

}  // namespace gpu_shading
