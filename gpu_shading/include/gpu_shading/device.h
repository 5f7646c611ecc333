#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gpu_shading {

// Which device renders.
struct DeviceChoice {
  enum class Kind {
    automatic,  // the first GPU, else software
    software,   // Mesa's software renderer, whatever else there is
    index,      // the one of this index in list_devices()
  };
  Kind kind = Kind::automatic;
  int index = 0;
};

// "auto", "software" or a number from 0. Throws Error on anything else.
DeviceChoice parse_device_choice(std::string const& text);

struct DeviceInfo {
  int index = 0;         // as in list_devices()
  std::string renderer;  // GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string vendor;    // GL_VENDOR
  std::string version;   // GL_VERSION, which names the driver
  bool software = false;
  int max_resolution = 0;  // largest square tile, pixels a side
};

// Every EGL device that gives an OpenGL 4.5 core context without a display, in EGL's order, then
// Mesa's surfaceless platform if that is another way. Devices that fail are left out; `failures`,
// if given, gets one line for each: the function, the decoded error, a hint.
std::vector<DeviceInfo> list_devices(std::vector<std::string>* failures = nullptr);

}  // namespace gpu_shading
