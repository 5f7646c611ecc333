#include "backends/opengl/module/gpu_presence.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "gpu_shading/renderer.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

namespace fs = std::filesystem;

// The folders of a machine whose only EGL is Mesa's, and that has no GPU.
class Machine {
 public:
  Machine() : root_(fs::temp_directory_path() / ("gpu_presence_" + std::to_string(getpid()))) {
    add("dev/null");
    add("vendors/50_mesa.json");
  }
  Machine(Machine const&) = delete;
  Machine& operator=(Machine const&) = delete;
  ~Machine() { fs::remove_all(root_); }

  void add(std::string const& file) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << "\n";
  }
  void remove(std::string const& file) const { fs::remove_all(root_ / file); }
  bool may_have_gpu() const {
    return gpu_shading::may_have_gpu({root_ / "dev", {root_ / "local", root_ / "vendors"}});
  }

 private:
  fs::path root_;
};

TEST(GpuPresence, NoneWhereMesaIsAloneWithoutDevices) { EXPECT_FALSE(Machine().may_have_gpu()); }

TEST(GpuPresence, ByTheKernelsDevices) {
  for (std::string const device : {"dri/renderD128", "dxg", "nvidiactl", "nvidia0", "kgsl-3d0"}) {
    Machine const machine;
    machine.add("dev/" + device);
    EXPECT_TRUE(machine.may_have_gpu()) << device;
  }
}

TEST(GpuPresence, ByAnotherVendorsEgl) {
  Machine const machine;
  machine.add("local/10_nvidia.json");
  EXPECT_TRUE(machine.may_have_gpu());
}

TEST(GpuPresence, ByAChosenDriver) {
  Machine const machine;
  for (char const* const variable :
       {"__EGL_VENDOR_LIBRARY_FILENAMES", "GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE"}) {
    setenv(variable, "something", 1);
    EXPECT_TRUE(machine.may_have_gpu()) << variable;
    unsetenv(variable);
  }
  EXPECT_FALSE(machine.may_have_gpu());
}

TEST(GpuPresence, UnknownWhereNothingCanBeRead) {
  Machine const machine;
  machine.remove("vendors");
  EXPECT_TRUE(machine.may_have_gpu()) << "EGL without GLVND";
  machine.add("vendors/50_mesa.json");
  machine.remove("dev");
  EXPECT_TRUE(machine.may_have_gpu()) << "no devices to be seen";
}

TEST(GpuPresence, NoOpenGlIsLoadedWhereThereIsNone) {
  if (may_have_gpu()) GTEST_SKIP() << "this machine has a GPU, or another EGL than Mesa's";
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 3)});
  Renderer const renderer(scene, {});
  EXPECT_TRUE(renderer.device().id.is_cpu());
  EXPECT_EQ(dlopen("libEGL.so.1", RTLD_LAZY | RTLD_NOLOAD), nullptr) << "libEGL was loaded";
}

}  // namespace
}  // namespace gpu_shading
