#pragma once

#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace gpu_shading::decoding {

// The version of the kernel's landlock; below 1 if the kernel has none or refuses it, as old
// profiles of containers do.
inline long landlock_version() {
  return syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
}

}  // namespace gpu_shading::decoding
