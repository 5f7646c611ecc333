#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"

namespace gpu_shading::egl {

// "FUNCTION failed: EGL_NAME (0xCODE); HINT" for this thread's last EGL error, which it clears.
std::string describe_failure(std::string_view function, std::string_view hint);

// An EGL display that needs no screen. EGL displays belong to the process: requesting one twice
// returns the same display, and terminating it would end every context on it, so they are never
// terminated.
struct Display {
  void* handle = nullptr;
  std::string label;      // for messages: "EGL device 0", "Mesa's surfaceless platform"
  bool software = false;  // the device reports that it renders in software
  bool surfaceless_platform = false;
};

// Every EGL device in EGL's order, then Mesa's surfaceless platform. Not initialised. Missing
// features are reported in `failures`, if given.
std::vector<Display> find_displays(std::vector<std::string>* failures);

}  // namespace gpu_shading::egl
