#pragma once

#include <string>
#include <vector>

namespace gpu_shading::egl {

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
