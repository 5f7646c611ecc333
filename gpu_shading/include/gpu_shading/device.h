#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading {

// Identifies a device: the module that drives it, and its number there, from 0.
struct DeviceId {
  std::string_view module = "cpu";  // in static storage; or "opengl"
  int number = 0;

  bool is_cpu() const { return module == "cpu"; }
  bool operator==(DeviceId const&) const = default;
};

// The device that a bare number names: one of OpenGL.
constexpr DeviceId numbered_device(int number) { return {"opengl", number}; }

// The choice of the device that computes.
struct DeviceChoice {
  std::optional<DeviceId> device;  // empty: the first GPU, or the CPU if there is none
  // OpenGL contexts that log misuse, which then throws Error. Slower; for tests.
  bool debug = false;

  bool operator==(DeviceChoice const&) const = default;
};

// Parses "auto", "cpu", or a number from 0, of an OpenGL device; devices of other modules are
// MODULE:NUMBER. Throws Error for anything else.
DeviceChoice parse_device_choice(std::string const& text);

// As parse_device_choice() reads them.
std::string device_name(DeviceId const& device);
std::string device_name(DeviceChoice const& choice);

struct DeviceInfo {
  DeviceId id;
  std::string renderer;    // GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"; "CPU"
  std::string vendor;      // GL_VENDOR
  std::string version;     // GL_VERSION, which names the driver; the CPU's instructions
  int threads = 0;         // of the CPU
  bool software = false;   // no GPU
  int max_resolution = 0;  // pixels along each side of the largest tile
};

// A name for messages: "CPU (2 threads, AVX2)", or the renderer and version of an OpenGL device.
std::string describe(DeviceInfo const& device);

// The CPU that this program runs on.
DeviceInfo cpu_device();

// From now on no more than `count` threads, the calling one among them, compute in this process at
// a time: a limit for all of oneTBB in it. Throws Error if it is less than 1.
void limit_threads(int count);

// Lists the devices of all modules; the CPU is the last. OpenGL has every EGL device that supports
// an OpenGL 4.5 core context without a display, in EGL's order, followed by Mesa's surfaceless
// platform if it adds another device. Devices that fail are left out; `failures`, if given, gets
// one line for each: the function, the decoded error, and a hint.
std::vector<DeviceInfo> list_devices(std::vector<std::string>* failures = nullptr);

}  // namespace gpu_shading
