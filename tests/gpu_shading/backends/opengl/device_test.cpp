#include "gpu_shading/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "backends/opengl/egl/device.h"
#include "backends/opengl/gl/limits.h"
#include "gpu_shading/error.h"
#include "support/refusal.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

Scene some_scene() {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  return scene;
}

std::string message_of(RendererOptions const& options) {
  try {
    Renderer const renderer(some_scene(), options);
  } catch (Error const& error) {
    return error.what();
  }
  return "";
}

std::vector<DeviceInfo> opengl_devices(std::vector<std::string>* failures = nullptr) {
  auto devices = list_devices(failures);
  std::erase_if(devices, [](DeviceInfo const& device) { return device.id.is_cpu(); });
  return devices;
}

TEST(Devices, AreNumberedFromZeroAndSayWhatTheyAre) {
  std::vector<std::string> failures;
  auto const devices = opengl_devices(&failures);
  ASSERT_FALSE(devices.empty()) << testing::PrintToString(failures);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].id, numbered_device(static_cast<int>(i)));
    EXPECT_FALSE(devices[i].renderer.empty());
    EXPECT_FALSE(devices[i].version.empty());
    EXPECT_GE(devices[i].max_resolution, 4096);
    std::printf("%zu: %s, %s%s\n", i, devices[i].renderer.c_str(), devices[i].version.c_str(),
                devices[i].software ? " (software)" : "");
  }
  // Where the test is run once more by another driver, that is the driver found.
  if (char const* const driver = std::getenv("GPU_SHADING_TEST_DRIVER")) {
    EXPECT_NE(devices.front().renderer.find(driver), std::string::npos);
  }
}

TEST(Devices, NeedNoDisplay) {
  // What a user over ssh may have: a display that is not there.
  setenv("DISPLAY", ":987", 1);
  EXPECT_FALSE(opengl_devices().empty());
  unsetenv("DISPLAY");
  EXPECT_FALSE(opengl_devices().empty());
}

TEST(Devices, EachByItsId) {
  for (DeviceInfo const& info : list_devices()) {
    Renderer const renderer(some_scene(), {parse_device_choice(device_name(info.id))});
    EXPECT_EQ(renderer.device().renderer, info.renderer);
    EXPECT_EQ(renderer.device().id, info.id);
  }
}

TEST(Devices, ANumberTooHighIsNamedWithHowManyThereAre) {
  auto const found = opengl_devices().size();
  RendererOptions const options{{numbered_device(77)}};
  EXPECT_THROW(Renderer(some_scene(), options), DeviceError);
  std::string const message = message_of(options);
  EXPECT_NE(message.find("77"), std::string::npos) << message;
  EXPECT_NE(message.find(std::to_string(found)), std::string::npos) << message;
}

TEST(Devices, TheCpuIsTheLast) {
  EXPECT_TRUE(list_devices().back().id.is_cpu());
  Renderer const renderer(some_scene(), {{DeviceId{}}});
  EXPECT_TRUE(renderer.device().software);
  EXPECT_EQ(renderer.device().id, list_devices().back().id);
  EXPECT_GE(renderer.device().threads, 1);
  EXPECT_EQ(describe(renderer.device()), describe(cpu_device()));
  EXPECT_EQ(describe(renderer.device()).find("CPU ("), 0U);
}

TEST(Devices, AGpuComesBeforeTheCpu) {
  auto const devices = list_devices();
  auto const gpu = std::find_if(devices.begin(), devices.end(),
                                [](DeviceInfo const& device) { return !device.software; });
  Renderer const renderer(some_scene(), {});
  EXPECT_EQ(renderer.device().id, gpu == devices.end() ? DeviceId{} : gpu->id);
}

TEST(Resolution, OutOfRangeIsNamedWithTheRange) {
  int const most = renderer_of(some_scene()).device().max_resolution;
  for (int const resolution : {0, -1, most + 1}) {
    RendererOptions options;
    options.resolution = resolution;
    options.samples_only = true;
    std::string const message = message_of(options);
    EXPECT_NE(message.find(std::to_string(resolution)), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(most)), std::string::npos) << message;
  }
}

TEST(Resolution, AnErrorOutOfRangeIsNamed) {
  for (double const error : {0.0, -1.0, 0.2, 1e-6, std::nan("")}) {
    RendererOptions options;
    options.error = error;
    EXPECT_NE(message_of(options).find("expected 1e-05 to 0.1"), std::string::npos) << error;
  }
}

TEST(Limits, OfStorageAreNamed) {
  auto const device = egl::open(by_opengl);
  ASSERT_TRUE(device);
  egl::Current const current = device->context.make_current();
  EXPECT_EQ(refusal_of([] { gl::require_storage(1000, "shades"); }), "accepted");
  std::string const message =
      refusal_of([] { gl::require_storage(std::size_t{1} << 50U, "shades"); });
  EXPECT_NE(message.find(device->info.renderer + ": shades take a storage block of 1073741824 MiB"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace gpu_shading
