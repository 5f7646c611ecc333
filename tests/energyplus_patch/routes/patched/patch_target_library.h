#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <link.h>

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "routes/patched/binary/symbol_table.h"

namespace gpu_shading::energyplus {

// The library of patch_target.cpp as it is on disk: every test loads a copy of its own.
class PatchTarget {
 public:
  explicit PatchTarget(std::string const& test)
      : path_(testing::TempDir() + "/patch_target_" + test + ".so") {
    std::ofstream(path_, std::ios::binary) << std::ifstream(PATCH_TARGET, std::ios::binary).rdbuf();
    handle_ = dlopen(path_.c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(handle_, nullptr) << dlerror();
  }

  SymbolTable symbols() const {
    static std::vector<std::string_view> const names{
        "_ZN12_GLOBAL__N_15twiceEi",
        "_ZN12_GLOBAL__N_16digitsEiiiiiiiiiiiiii",
        "reads_memory_first",
        "jumps_first",
        "too_short",
        "gives_number",
        "stores_number",
        "call_twice",
        "gives_integer",
        "gives_real",
    };
    link_map* map = nullptr;
    dlinfo(handle_, RTLD_DI_LINKMAP, &map);
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    return {path_, reinterpret_cast<std::byte*>(map->l_addr), names};
  }

  template <typename... Arguments>
  int call(char const* name, Arguments... arguments) const {
    auto* const function = reinterpret_cast<int (*)(Arguments...)>(dlsym(handle_, name));
    return function(arguments...);
  }

 private:
  std::string path_;
  void* handle_ = nullptr;
};

}  // namespace gpu_shading::energyplus
