#include "backends/opengl/module/gl_module.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

#define GPU_SHADING_NAME_OF(symbol) #symbol
#define GPU_SHADING_NAME(symbol) GPU_SHADING_NAME_OF(symbol)

constexpr char const* library = "libgpu_shading_gl.so";
constexpr char const* entry_name = GPU_SHADING_NAME(GPU_SHADING_GL_MODULE);

// Empty if it is not known.
std::filesystem::path folder_of_this_code() noexcept try {
  Dl_info info{};
  link_map* map = nullptr;
  dladdr1(reinterpret_cast<void const*>(&gl_module), &info, reinterpret_cast<void**>(&map),
          RTLD_DL_LINKMAP);
  // A program itself has no name there.
  if (map != nullptr && map->l_name != nullptr && *map->l_name != '\0') {
    return std::filesystem::absolute(map->l_name).parent_path();
  }
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
} catch (...) {
  return {};
}

// As this code is loaded: a library may be named relative to the folder that is current then.
std::filesystem::path const code_folder = folder_of_this_code();

// Drivers, which compile shaders with LLVM, do not survive where memory ends.
void require_address_space() {
  constexpr std::uint64_t needed = 1024;
  constexpr std::uint64_t mib = std::uint64_t{1} << 20U;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  std::uint64_t pages = 0;  // in use
  std::ifstream("/proc/self/statm") >> pages;
  auto const used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  auto const left = limit.rlim_cur > used ? (limit.rlim_cur - used) / mib : 0;
  if (left >= needed) return;
  throw DeviceError(fmt::format(
      "no OpenGL: it needs {} MiB of address space, and of {} MiB (ulimit -v) {} are left", needed,
      limit.rlim_cur / mib, left));
}

DeviceModule const& load() {
  require_address_space();
  std::error_code error;
  auto const beside = code_folder / library;
  bool const is_beside = !code_folder.empty() && std::filesystem::exists(beside, error);
  void* const handle = dlopen(is_beside ? beside.c_str() : library, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw DeviceError(fmt::format("no OpenGL: {}", dlerror()));
  auto* const entry = reinterpret_cast<decltype(&GPU_SHADING_GL_MODULE)>(dlsym(handle, entry_name));
  if (entry == nullptr) {
    throw DeviceError(fmt::format(
        "no OpenGL: {} is from another build than this program; install both from one package",
        is_beside ? beside.string() : library));
  }
  return *entry();
}

}  // namespace

DeviceModule const& gl_module() {
  static DeviceModule const& loaded = load();
  // Drivers have threads and connections, which a forked process does not get.
  static pid_t const process = getpid();
  if (getpid() != process) {
    throw DeviceError("no OpenGL: this process was forked from one that had already loaded it");
  }
  return loaded;
}

}  // namespace gpu_shading
