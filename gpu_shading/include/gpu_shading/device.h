#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gpu_shading {

// The choice of the device that computes.
struct DeviceChoice {
  enum class Kind {
    automatic,  // the first GPU, else the CPU
    cpu,        // no OpenGL at all
    index,      // the device with this index in list_devices()
  };
  Kind kind = Kind::automatic;
  int index = 0;
  // OpenGL contexts that log misuse, which then throws Error. Slower; for tests.
  bool debug = false;

  bool operator==(DeviceChoice const&) const = default;
};

// Parses "auto", "cpu" or a number from 0. Throws Error for anything else.
DeviceChoice parse_device_choice(std::string const& text);

struct DeviceInfo {
  int index = -1;          // as in list_devices(); -1: the CPU
  std::string renderer;    // GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"; "CPU"
  std::string vendor;      // GL_VENDOR
  std::string version;     // GL_VERSION, which names the driver; the CPU's instructions
  int threads = 0;         // of the CPU
  bool software = false;   // no GPU
  int max_resolution = 0;  // pixels along each side of the largest tile
};

// The choice of this very device.
DeviceChoice choice_of(DeviceInfo const& device);

// A name for messages: "CPU (2 threads, AVX2)", or the renderer and version of an OpenGL device.
std::string describe(DeviceInfo const& device);

// The CPU that this program runs on.
DeviceInfo cpu_device();

// Lists every EGL device that supports an OpenGL 4.5 core context without a display, in EGL's
// order, followed by Mesa's surfaceless platform if it adds another device. Devices that fail are
// left out; `failures`, if given, gets one line for each: the function, the decoded error, and a
// hint.
std::vector<DeviceInfo> list_devices(std::vector<std::string>* failures = nullptr);

}  // namespace gpu_shading
