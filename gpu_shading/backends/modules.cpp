#include "backends/modules.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

#include "backends/cpu/cpu_backend.h"
#include "backends/cpu/cpu_picture_raster.h"
#include "backends/opengl/module/gl_module.h"
#include "backends/opengl/module/gpu_presence.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

class CpuModule : public DeviceModule {
 public:
  std::vector<DeviceInfo> list_devices(std::vector<std::string>& /*failures*/) const override {
    return {cpu_device()};
  }
  std::unique_ptr<ViewBackend> open(BackendInput const& input,
                                    DeviceChoice const& /*choice*/) const override {
    return std::make_unique<CpuBackend>(input);
  }
  std::unique_ptr<PictureRaster> open_for_pictures(PictureScene const& scene,
                                                   DeviceChoice const& /*choice*/) const override {
    return std::make_unique<CpuPictureRaster>(scene);
  }
};

DeviceModule const& cpu_module() {
  static CpuModule const module;
  return module;
}

constexpr std::array modules{
    NamedModule{"opengl", gl_module, [] { return may_have_gpu(); }},
    NamedModule{"cpu", cpu_module, [] { return true; }},
};

// A number from 0; empty for anything else.
std::optional<int> parse_number(std::string_view text) {
  int number = -1;
  char const* const end = text.data() + text.size();
  auto const [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end || number < 0) return std::nullopt;
  return number;
}

std::optional<DeviceId> parse_device(std::string_view text) {
  if (auto const number = parse_number(text)) return numbered_device(*number);
  DeviceId const cpu;
  if (text == cpu.module) return cpu;
  auto const colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  for (NamedModule const& module : device_modules()) {
    auto const number = parse_number(text.substr(colon + 1));
    bool const named = module.name == text.substr(0, colon) && module.name != cpu.module;
    if (named && number) return DeviceId{module.name, *number};
  }
  return std::nullopt;
}

}  // namespace

std::span<NamedModule const> device_modules() { return modules; }

DeviceChoice parse_device_choice(std::string const& text) {
  if (text == "auto") return {};
  if (auto const device = parse_device(text)) return {device};
  throw Error(
      fmt::format("device '{}': expected 'auto', 'cpu' or the number of a device, from 0", text));
}

std::string device_name(DeviceId const& device) {
  if (device.is_cpu()) return std::string(device.module);
  bool const numbered = device == numbered_device(device.number);
  return numbered ? fmt::format("{}", device.number)
                  : fmt::format("{}:{}", device.module, device.number);
}

std::string device_name(DeviceChoice const& choice) {
  return choice.device ? device_name(*choice.device) : "auto";
}

std::string describe(DeviceInfo const& device) {
  if (device.threads == 0) return fmt::format("{} ({})", device.renderer, device.version);
  return fmt::format("{} ({} thread{}, {})", device.renderer, device.threads,
                     device.threads == 1 ? "" : "s", device.version);
}

std::vector<DeviceInfo> list_devices(std::vector<std::string>* failures) {
  std::vector<std::string> unasked;
  std::vector<std::string>& lines = failures != nullptr ? *failures : unasked;
  std::vector<DeviceInfo> devices;
  for (NamedModule const& module : device_modules()) {
    try {
      for (DeviceInfo& device : module.get().list_devices(lines)) {
        devices.push_back(std::move(device));
      }
    } catch (DeviceError const& error) {
      lines.emplace_back(error.what());
    }
  }
  return devices;
}

}  // namespace gpu_shading
