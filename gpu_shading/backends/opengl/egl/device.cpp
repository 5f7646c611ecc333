#include "backends/opengl/egl/device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/limits.h"
#include "gpu_shading/error.h"

namespace gpu_shading::egl {
namespace {

bool is_software_renderer(std::string_view renderer) {
  constexpr std::array<std::string_view, 4> known = {"llvmpipe", "softpipe", "swrast", "SWR"};
  return std::any_of(known.begin(), known.end(), [&](std::string_view name) {
    return renderer.find(name) != std::string_view::npos;
  });
}

[[noreturn]] void fail_to_open(int index, int count, std::vector<std::string> const& failures) {
  std::string const reasons =
      failures.empty() ? "" : fmt::format(" ({})", fmt::join(failures, "; "));
  if (count == 0) {
    throw DeviceError(
        "no device gives an OpenGL 4.5 context without a display; install a graphics driver or "
        "Mesa's software renderer (libegl1, libgl1-mesa-dri), or use the device cpu" +
        reasons);
  }
  throw DeviceError(fmt::format("there is no device {}: {} found, numbered from 0{}", index,
                                count == 1 ? "1 is" : fmt::format("{} are", count), reasons));
}

}  // namespace

DeviceWalk::DeviceWalk(bool debug) : debug_(debug), displays_(find_displays(&failures_)) {}

bool DeviceWalk::is_known(std::string const& renderer) const {
  return std::find(renderers_.begin(), renderers_.end(), renderer) != renderers_.end();
}

std::optional<Device> DeviceWalk::next() {
  while (at_ < displays_.size()) {
    Display const& display = displays_[at_++];
    try {
      Device device{Context(display, debug_), {}};
      {
        Current const current = device.context.make_current();
        if (debug_) gl::log_misuse();
        gl::Limits const limits = gl::query_limits();
        device.info.renderer = limits.renderer;
        device.info.vendor = limits.vendor;
        device.info.version = limits.version;
        device.info.max_resolution = limits.max_target_size;
      }
      // The surfaceless platform opens one of the devices a second time, unless EGL could not list
      // it.
      if (display.surfaceless_platform && is_known(device.info.renderer)) continue;
      device.info.software = display.software || is_software_renderer(device.info.renderer);
      device.info.id = numbered_device(static_cast<int>(renderers_.size()));
      renderers_.push_back(device.info.renderer);
      return device;
    } catch (DeviceError const& error) {
      failures_.emplace_back(error.what());
    }
  }
  return std::nullopt;
}

std::optional<Device> open(DeviceChoice const& choice) {
  DeviceWalk walk(choice.debug);
  int count = 0;
  while (std::optional<Device> device = walk.next()) {
    bool const wanted = choice.device ? device->info.id == *choice.device : !device->info.software;
    if (wanted) return device;
    ++count;
  }
  if (choice.device) fail_to_open(choice.device->number, count, walk.failures());
  return std::nullopt;
}

}  // namespace gpu_shading::egl
