// gpu_shading: what is not a simulation.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/error.h"
#include "program/check.h"

namespace gpu_shading::energyplus {
namespace {

void print_devices() {
  std::vector<std::string> failures;
  auto const devices = list_devices(&failures);
  for (auto const& device : devices) {
    fmt::print("{}  {}  [{}; {}]  {}, tiles up to {} x {}\n", device.index, device.renderer,
               device.vendor, device.version, device.software ? "software" : "GPU",
               device.max_resolution, device.max_resolution);
  }
  for (auto const& failure : failures) fmt::print(stderr, "gpu_shading: {}\n", failure);
  if (devices.empty()) {
    throw DeviceError(
        "no EGL device gives an OpenGL 4.5 core context; for rendering in software "
        "install Mesa (Debian: libegl-mesa0, libgl1-mesa-dri)");
  }
}

int run(int argc, char** argv) {
  CLI::App app{"Devices and checks for EnergyPlus with GPU shading", "gpu_shading"};
  app.require_subcommand(1);
  app.add_subcommand("devices",
                     "List the devices that can render; the number is what "
                     "--gpu-shading-device takes")
      ->callback(print_devices);

  auto* const check_command = app.add_subcommand(
      "check",
      "Read a model and its extension objects; print what each surface will be to the "
      "shading calculation, or every error");
  std::string model;
  std::string weather;
  std::string file;
  check_command->add_option("model", model, "IDF or epJSON file")->required();
  check_command->add_option("-w,--weather", weather, "Weather file (default: one of EnergyPlus's)");
  check_command->add_option("--gpu-shading-file", file, "Extension objects in a file of their own");
  bool vertices = false;
  check_command->add_flag("--vertices", vertices, "Print every surface's vertices instead");
  check_command->callback([&] {
    Choices choices = read_environment();
    if (!file.empty()) choices.file = file;
    check(model, weather.empty() ? std::nullopt : std::optional<std::filesystem::path>(weather),
          choices, vertices);
  });
  CLI11_PARSE(app, argc, argv);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace gpu_shading::energyplus

int main(int argc, char** argv) {
  try {
    return gpu_shading::energyplus::run(argc, argv);
  } catch (std::exception const& error) {
    std::fprintf(stderr, "gpu_shading: error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
