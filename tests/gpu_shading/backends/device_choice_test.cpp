#include <gtest/gtest.h>

#include <string>

#include "gpu_shading/device.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

TEST(DeviceChoice, AutoCpuOrANumber) {
  EXPECT_EQ(parse_device_choice("auto").kind, DeviceChoice::Kind::automatic);
  EXPECT_EQ(parse_device_choice("cpu").kind, DeviceChoice::Kind::cpu);
  DeviceChoice const third = parse_device_choice("2");
  EXPECT_EQ(third.kind, DeviceChoice::Kind::index);
  EXPECT_EQ(third.index, 2);
}

TEST(DeviceChoice, AnythingElseIsRefusedByName) {
  for (std::string const text : {"", "gpu", "software", "-1", "1.5", "2 ", "99999999999", "Auto"}) {
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
