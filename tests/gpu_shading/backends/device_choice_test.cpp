#include <gtest/gtest.h>

#include <string>

#include "backends/modules.h"
#include "gpu_shading/device.h"
#include "gpu_shading/error.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {
namespace {

TEST(DeviceChoice, AutoCpuOrANumber) {
  EXPECT_FALSE(parse_device_choice("auto").device);
  EXPECT_EQ(parse_device_choice("cpu").device, DeviceId{});
  EXPECT_EQ(parse_device_choice("2").device, numbered_device(2));
}

TEST(DeviceChoice, ModuleAndNumber) {
  for (NamedModule const& module : device_modules()) {
    DeviceId const second{module.name, 1};
    if (second.is_cpu()) continue;
    EXPECT_EQ(parse_device_choice(std::string(module.name) + ":1").device, second);
  }
}

TEST(DeviceChoice, HasANameThatIsParsed) {
  for (std::string const text : {"auto", "cpu", "0", "12"}) {
    EXPECT_EQ(device_name(parse_device_choice(text)), text);
  }
  EXPECT_EQ(device_name(DeviceId{"vulkan", 1}), "vulkan:1");
}

TEST(DeviceChoice, OfAModuleThatIsMissingIsRefusedByName) {
  try {
    Renderer const renderer({}, {{DeviceId{"vulkan", 1}}});
    ADD_FAILURE() << "accepted";
  } catch (DeviceError const& error) {
    EXPECT_NE(std::string(error.what()).find("device vulkan:1: "), std::string::npos);
  }
}

TEST(DeviceChoice, AnythingElseIsRefusedByName) {
  for (std::string const text : {"", "gpu", "-1", "1.5", "2 ", "99999999999", "Auto", "software",
                                 "vulkan:0", "opengl:", "opengl:-1", ":1", "cpu:0"}) {
    try {
      parse_device_choice(text);
      ADD_FAILURE() << "'" << text << "' was taken";
    } catch (Error const& error) {
      EXPECT_NE(std::string(error.what()).find("'" + text + "'"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace gpu_shading
