#include <fmt/format.h>

#include <charconv>

#include "backends/opengl/module/gl_module.h"
#include "gpu_shading/device.h"
#include "gpu_shading/error.h"

namespace gpu_shading {

DeviceChoice parse_device_choice(std::string const& text) {
  if (text == "auto") return {DeviceChoice::Kind::automatic, 0};
  if (text == "cpu") return {DeviceChoice::Kind::cpu, 0};
  int index = -1;
  char const* const end = text.data() + text.size();
  auto const [last, error] = std::from_chars(text.data(), end, index);
  if (error != std::errc() || last != end || index < 0) {
    throw Error(
        fmt::format("device '{}': expected 'auto', 'cpu' or the number of a device, from 0", text));
  }
  return {DeviceChoice::Kind::index, index};
}

DeviceChoice choice_of(DeviceInfo const& device) {
  if (device.index < 0) return {DeviceChoice::Kind::cpu};
  return {DeviceChoice::Kind::index, device.index};
}

std::string describe(DeviceInfo const& device) {
  if (device.threads == 0) return fmt::format("{} ({})", device.renderer, device.version);
  return fmt::format("{} ({} thread{}, {})", device.renderer, device.threads,
                     device.threads == 1 ? "" : "s", device.version);
}

std::vector<DeviceInfo> list_devices(std::vector<std::string>* failures) {
  std::vector<std::string> unasked;
  std::vector<std::string>& lines = failures != nullptr ? *failures : unasked;
  try {
    return gl_module().list_devices(lines);
  } catch (DeviceError const& error) {
    lines.emplace_back(error.what());
    return {};
  }
}

}  // namespace gpu_shading
