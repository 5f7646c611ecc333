#include "backends/opengl/egl/display.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/format.h>

#include <array>
#include <string_view>

namespace gpu_shading::egl {

namespace {

char const* name_of(EGLint error) {
  switch (error) {
    case EGL_SUCCESS:
      return "EGL_SUCCESS";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    case EGL_CONTEXT_LOST:
      return "EGL_CONTEXT_LOST";
    default:
      return "unknown EGL error";
  }
}

}  // namespace

std::string describe_failure(std::string_view function, std::string_view hint) {
  EGLint const error = eglGetError();
  return fmt::format("{} failed: {} ({:#06x}); {}", function, name_of(error), error, hint);
}

namespace {

bool lists(char const* extensions, std::string_view wanted) {
  std::string_view const all = extensions == nullptr ? "" : extensions;
  for (std::size_t at = all.find(wanted); at != std::string_view::npos;
       at = all.find(wanted, at + 1)) {
    std::size_t const end = at + wanted.size();
    bool const starts = at == 0 || all[at - 1] == ' ';
    if (starts && (end == all.size() || all[end] == ' ')) return true;
  }
  return false;
}

void report(std::vector<std::string>* failures, std::string line) {
  if (failures != nullptr) failures->push_back(std::move(line));
}

// libepoxy loads the driver's libraries at its first call, and ends the process where one is
// missing.
bool has_libraries(std::vector<std::string>* failures) {
  constexpr std::array<std::array<char const*, 2>, 2> wanted{
      {{"libEGL.so.1", "libEGL.so.1"}, {"libOpenGL.so.0", "libGL.so.1"}}};
  for (auto const& [name, other] : wanted) {
    if (dlopen(name, RTLD_LAZY | RTLD_LOCAL) != nullptr) continue;
    if (dlopen(other, RTLD_LAZY | RTLD_LOCAL) != nullptr) continue;
    report(failures, fmt::format("{}; install a graphics driver, or Mesa (libegl1, "
                                 "libgl1-mesa-dri)",
                                 dlerror()));
    return false;
  }
  return true;
}

void add_devices(std::vector<Display>& displays, std::vector<std::string>* failures) {
  EGLint count = 0;
  if (eglQueryDevicesEXT(0, nullptr, &count) != EGL_TRUE) {
    report(failures, describe_failure("eglQueryDevicesEXT", "is a graphics driver installed?"));
    return;
  }
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (eglQueryDevicesEXT(count, devices.data(), &count) != EGL_TRUE) {
    report(failures, describe_failure("eglQueryDevicesEXT", "is a graphics driver installed?"));
    return;
  }
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT const device = devices[static_cast<std::size_t>(i)];
    Display display;
    display.label = fmt::format("EGL device {}", i);
    display.handle = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (display.handle == EGL_NO_DISPLAY) {
      report(failures, display.label + ": " +
                           describe_failure("eglGetPlatformDisplayEXT",
                                            "the driver of this device provides no display"));
      continue;
    }
    display.software =
        lists(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    displays.push_back(display);
  }
}

}  // namespace

std::vector<Display> find_displays(std::vector<std::string>* failures) {
  std::vector<Display> displays;
  if (!has_libraries(failures)) return displays;
  char const* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_EXT_platform_base")) {
    report(failures, describe_failure("eglQueryString(EGL_EXT_platform_base)",
                                      "install an EGL of version 1.5 (libegl1)"));
    return displays;
  }
  if (lists(extensions, "EGL_EXT_platform_device") &&
      (lists(extensions, "EGL_EXT_device_enumeration") ||
       lists(extensions, "EGL_EXT_device_base"))) {
    add_devices(displays, failures);
  } else {
    report(failures, "EGL cannot list devices (no EGL_EXT_device_enumeration); update the driver");
  }
  if (lists(extensions, "EGL_MESA_platform_surfaceless")) {
    Display display;
    display.label = "Mesa's surfaceless platform";
    display.surfaceless_platform = true;
    display.handle =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display.handle != EGL_NO_DISPLAY) displays.push_back(display);
  }
  return displays;
}

}  // namespace gpu_shading::egl
