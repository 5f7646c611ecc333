#include "programs/gpu_shading/device_table.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/device_test.h"
#include "platform/console.h"

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
  print_text(fmt::format(
      "Largest error of a sunlit fraction, and milliseconds per view:\n\n{}\n{}\n", titles, units));
  for (std::size_t row = 0; row < tests.back().kinds.size(); ++row) {
    std::string line = fmt::format("{:24}", tests.back().kinds[row].name);
    for (auto const& test : tests) {
      line += row < test.kinds.size() ? fmt::format("{:>10.1e}{:>10.3f}", test.kinds[row].error,
                                                    test.kinds[row].milliseconds)
                                      : fmt::format("{:>20}", "-");
    }
    print_text(fmt::format("{}\n", line));
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

}  // namespace

void list_devices() {
  for (auto const& device : find_devices()) {
    auto const name = device_name(device.id);
    print_text(device.id.is_cpu() ? fmt::format("{}  {}\n", name, describe(device))
                                  : fmt::format("{}  {}  [{}; {}]  {}, tiles up to {} x {}\n", name,
                                                device.renderer, device.vendor, device.version,
                                                device.software ? "software" : "GPU",
                                                device.max_resolution, device.max_resolution));
  }
}

bool test_devices() {
  std::vector<DeviceTest> tests;
  for (auto const& device : find_devices()) tests.push_back(test_device(device));
  print_table(tests);
  bool right = true;
  print_text("\n");
  for (auto const& test : tests) {
    print_text(fmt::format("{}  {}: {}\n", device_name(test.device.id), describe(test.device),
                           verdict(test, tests.back())));
    right = right && test.right();
  }
  return right;
}

}  // namespace gpu_shading::energyplus
