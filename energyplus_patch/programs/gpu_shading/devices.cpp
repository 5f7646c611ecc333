#include <fmt/format.h>

#include <string>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/device_test.h"
#include "platform/console.h"
#include "programs/gpu_shading/commands.h"

namespace gpu_shading::energyplus {
namespace {

std::vector<DeviceInfo> find_devices() {
  std::vector<std::string> failures;
  auto devices = gpu_shading::list_devices(&failures);
  for (auto const& failure : failures) print_line(failure);
  return devices;
}

// Rows are kinds of view, and devices columns.
void print_table(std::vector<DeviceTest> const& tests) {
  std::string titles = fmt::format("{:24}", "");
  std::string units = titles;
  for (auto const& test : tests) {
    auto const name = device_name(test.device.id);
    titles += fmt::format("{:>20}", test.device.id.is_cpu() ? name : "device " + name);
    units += fmt::format("{:>10}{:>10}", "error", "ms");
  }
  print("Largest error of a sunlit fraction, and milliseconds per view:\n\n{}\n{}\n", titles,
        units);
  for (std::size_t row = 0; row < tests.back().kinds.size(); ++row) {
    std::string line = fmt::format("{:24}", tests.back().kinds[row].name);
    for (auto const& test : tests) {
      line += row < test.kinds.size() ? fmt::format("{:>10.1e}{:>10.3f}", test.kinds[row].error,
                                                    test.kinds[row].milliseconds)
                                      : fmt::format("{:>20}", "-");
    }
    print("{}\n", line);
  }
}

std::string compare_times(DeviceTest const& test, DeviceTest const& cpu) {
  if (test.device.id.is_cpu()) return "";
  double const ratio = cpu.milliseconds() / test.milliseconds();
  return ratio >= 1.0 ? fmt::format(", {:.2g} times as fast as the CPU", ratio)
                      : fmt::format(", takes {:.2g} times as long as the CPU", 1.0 / ratio);
}

std::string verdict(DeviceTest const& test, DeviceTest const& cpu) {
  if (!test.failure.empty()) return "FAILED: " + test.failure;
  std::string wrong;
  for (auto const& kind : test.kinds) {
    if (!kind.right()) {
      wrong += fmt::format("{}{} by {:.2g}", wrong.empty() ? "" : ", ", kind.name, kind.error);
    }
  }
  if (wrong.empty()) return "right" + compare_times(test, cpu);
  return fmt::format("WRONG: {}; at most {} is right. Update its driver, or use another device",
                     wrong, DeviceTest::tolerance);
}

void list_devices() {
  for (auto const& device : find_devices()) {
    auto const name = device_name(device.id);
    if (device.id.is_cpu()) {
      print("{}  {}\n", name, describe(device));
    } else {
      print("{}  {}  [{}; {}]  {}, tiles up to {} x {}\n", name, device.renderer, device.vendor,
            device.version, device.software ? "software" : "GPU", device.max_resolution,
            device.max_resolution);
    }
  }
}

bool test_devices() {
  std::vector<DeviceTest> tests;
  for (auto const& device : find_devices()) tests.push_back(test_device(device));
  print_table(tests);
  bool right = true;
  print_text("\n");
  for (auto const& test : tests) {
    print("{}  {}: {}\n", device_name(test.device.id), describe(test.device),
          verdict(test, tests.back()));
    right = right && test.right();
  }
  return right;
}

}  // namespace

void add_devices(Program const& program, bool& right) {
  Command const command(
      program, "devices",
      "List the devices that can render, with their numbers for --gpu-shading-device",
      {"threads", "quiet"});
  auto const test = std::make_shared<bool>(false);
  command->add_flag("--test", *test,
                    "Test each device and the CPU on cases with known answers; print errors, times "
                    "and a verdict. The exit status is 1 if one is wrong");
  command.run([test, &right] {
    if (*test) {
      right = test_devices();
    } else {
      list_devices();
    }
  });
}

}  // namespace gpu_shading::energyplus
