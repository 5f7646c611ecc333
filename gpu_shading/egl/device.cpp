#include "egl/device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "gl/limits.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace egl {
namespace {

bool is_software_renderer(std::string_view renderer) {
  constexpr std::array<std::string_view, 4> known = {"llvmpipe", "softpipe", "swrast", "SWR"};
  return std::any_of(known.begin(), known.end(), [&](std::string_view name) {
    return renderer.find(name) != std::string_view::npos;
  });
}

}  // namespace

DeviceWalk::DeviceWalk() : displays_(find_displays(&failures_)) {}

bool DeviceWalk::is_known(std::string const& renderer) const {
  return std::find(renderers_.begin(), renderers_.end(), renderer) != renderers_.end();
}

std::optional<Device> DeviceWalk::next() {
  while (at_ < displays_.size()) {
    Display const& display = displays_[at_++];
    try {
      Device device{Context(display), {}};
      {
        Current const current = device.context.make_current();
        gl::Limits const limits = gl::query_limits();
        device.info.renderer = limits.renderer;
        device.info.vendor = limits.vendor;
        device.info.version = limits.version;
        device.info.max_resolution = limits.max_target_size;
      }
      // The surfaceless platform opens one of the devices again, unless EGL could not list it.
      if (display.surfaceless_platform && is_known(device.info.renderer)) continue;
      device.info.software = display.software || is_software_renderer(device.info.renderer);
      device.info.index = static_cast<int>(renderers_.size());
      renderers_.push_back(device.info.renderer);
      return device;
    } catch (DeviceError const& error) {
      failures_.emplace_back(error.what());
    }
  }
  return std::nullopt;
}

Device open_device(DeviceChoice const& choice) {
  DeviceWalk walk;
  std::optional<Device> software;
  int count = 0;
  while (std::optional<Device> device = walk.next()) {
    ++count;
    bool wanted = false;
    switch (choice.kind) {
      case DeviceChoice::Kind::automatic:
        wanted = !device->info.software;
        break;
      case DeviceChoice::Kind::software:
        wanted = device->info.software;
        break;
      case DeviceChoice::Kind::index:
        wanted = device->info.index == choice.index;
        break;
    }
    if (wanted) return std::move(*device);
    if (device->info.software && !software) software = std::move(device);
  }
  if (choice.kind == DeviceChoice::Kind::automatic && software) return std::move(*software);

  std::string const failures =
      walk.failures().empty() ? "" : fmt::format(" ({})", fmt::join(walk.failures(), "; "));
  if (count == 0) {
    throw DeviceError(
        "no device gives an OpenGL 4.5 context without a display; install a graphics driver or "
        "Mesa's software renderer (libegl1, libgl1-mesa-dri)" +
        failures);
  }
  if (choice.kind == DeviceChoice::Kind::index) {
    throw DeviceError(fmt::format("there is no device {}: {} found, numbered from 0{}",
                                  choice.index, count == 1 ? "1 is" : fmt::format("{} are", count),
                                  failures));
  }
  throw DeviceError(
      "there is no software renderer; install Mesa's (libegl-mesa0, libgl1-mesa-dri)" + failures);
}

}  // namespace egl

DeviceChoice parse_device_choice(std::string const& text) {
  if (text == "auto") return {DeviceChoice::Kind::automatic, 0};
  if (text == "software") return {DeviceChoice::Kind::software, 0};
  int index = -1;
  char const* const end = text.data() + text.size();
  auto const [last, error] = std::from_chars(text.data(), end, index);
  if (error != std::errc() || last != end || index < 0) {
    throw Error(fmt::format(
        "device '{}': expected 'auto', 'software' or the number of a device, from 0", text));
  }
  return {DeviceChoice::Kind::index, index};
}

std::vector<DeviceInfo> list_devices(std::vector<std::string>* failures) {
  egl::DeviceWalk walk;
  std::vector<DeviceInfo> devices;
  while (std::optional<egl::Device> const device = walk.next()) devices.push_back(device->info);
  if (failures != nullptr) {
    failures->insert(failures->end(), walk.failures().begin(), walk.failures().end());
  }
  return devices;
}

}  // namespace gpu_shading
