#include "backends/opengl/module/gpu_presence.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace gpu_shading {
namespace {

namespace fs = std::filesystem;

// Names of the files in a folder; none if it cannot be read.
std::vector<std::string> files_of(fs::path const& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    names.push_back(file->path().filename().string());
  }
  return names;
}

bool is_anything_chosen() {
  constexpr std::array variables = {"__EGL_VENDOR_LIBRARY_FILENAMES", "__EGL_VENDOR_LIBRARY_DIRS",
                                    "GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE",
                                    "LIBGL_DRIVERS_PATH"};
  return std::any_of(variables.begin(), variables.end(),
                     [](char const* name) { return std::getenv(name) != nullptr; });
}

bool is_mesa_alone(std::vector<fs::path> const& folders) {
  bool any = false;
  for (fs::path const& folder : folders) {
    for (std::string const& name : files_of(folder)) {
      if (name.find("mesa") == std::string::npos) return false;
      any = true;
    }
  }
  return any;
}

// The kernel's: DRM, DirectX (WSL), and those of vendors' own drivers.
bool has_device(fs::path const& devices) {
  constexpr std::array<std::string_view, 7> starts = {"dri",  "dxg", "nvidia", "nvmap",
                                                      "mali", "kfd", "kgsl"};
  std::vector<std::string> const names = files_of(devices);
  return names.empty() || std::any_of(names.begin(), names.end(), [&](std::string const& name) {
           return std::any_of(starts.begin(), starts.end(),
                              [&](std::string_view start) { return name.starts_with(start); });
         });
}

}  // namespace

bool may_have_gpu(GpuTraces const& traces) {
  return is_anything_chosen() || has_device(traces.devices) || !is_mesa_alone(traces.vendors);
}

}  // namespace gpu_shading
