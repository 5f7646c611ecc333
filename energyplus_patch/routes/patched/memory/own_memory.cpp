#include "routes/patched/memory/own_memory.h"

#include <sys/uio.h>
#include <unistd.h>

namespace gpu_shading::energyplus {

bool read_memory(void const* from, void* to, std::size_t size) {
  iovec const local{to, size};
  iovec const remote{const_cast<void*>(from), size};
  return process_vm_readv(getpid(), &local, 1, &remote, 1, 0) == static_cast<ssize_t>(size);
}

std::byte* read_pointer(void const* from) { return read_value<std::byte*>(from).value_or(nullptr); }

}  // namespace gpu_shading::energyplus
