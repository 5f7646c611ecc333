#pragma once

#include <filesystem>
#include <vector>

namespace gpu_shading {

// Where a machine shows that it has a GPU.
struct GpuTraces {
  std::filesystem::path devices = "/dev";
  // Of GLVND: a file for each vendor's EGL.
  std::vector<std::filesystem::path> vendors{"/etc/glvnd/egl_vendor.d",
                                             "/usr/share/glvnd/egl_vendor.d"};
};

// Whether to look for a GPU by EGL, which loads Mesa's software renderer and LLVM (20 ms and 56 MB)
// where there is none. False only if that cannot find one: Mesa is the only vendor, no environment
// variable sends EGL elsewhere, and the kernel has no device that a driver could open.
bool may_have_gpu(GpuTraces const& traces = {});

}  // namespace gpu_shading
