#include "routes/opengl/windows/entries.h"

#include <windows.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "routes/opengl/opengl_functions.h"

namespace gpu_shading::energyplus {
namespace {

// The library's threads must not lose their code when GLFW unloads it.
void stay_loaded() {
  HMODULE self = nullptr;
  GetModuleHandleExA(GET_MODULE_HANDLE_EX_FLAG_PIN | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS,
                     reinterpret_cast<char const*>(&stay_loaded), &self);
}

void* create_context(HDC /*device*/) {
  stay_loaded();
  void* context = nullptr;
  or_end_run([&] { context = std::make_unique<OpenGlContext>().release(); });
  return context;
}

int delete_context(void* context) {
  auto* const deleted = static_cast<OpenGlContext*>(context);
  if (current_context() == deleted) use_context(nullptr);
  or_end_run([&] { std::unique_ptr<OpenGlContext>{deleted}.reset(); });
  return 1;
}

int make_current(HDC device, void* context) {
  auto* const current = static_cast<OpenGlContext*>(context);
  use_context(current);
  if (current != nullptr) current->device = device;
  return 1;
}

void* get_current_context() { return current_context(); }
HDC get_current_device() {
  auto const* const current = current_context();
  return current == nullptr ? nullptr : static_cast<HDC>(current->device);
}
int succeed() { return 1; }

// The only pixel format.
int describe_pixel_format(HDC /*device*/, int /*format*/, UINT size,
                          PIXELFORMATDESCRIPTOR* description) {
  if (description == nullptr || size < sizeof(PIXELFORMATDESCRIPTOR)) return 1;
  constexpr BYTE channel = 8;
  *description = {};
  description->nSize = sizeof(PIXELFORMATDESCRIPTOR);
  description->nVersion = 1;
  description->dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
  description->iPixelType = PFD_TYPE_RGBA;
  description->cColorBits = 4 * channel;
  description->cRedBits = channel;
  description->cGreenBits = channel;
  description->cBlueBits = channel;
  description->cAlphaBits = channel;
  description->cDepthBits = 3 * channel;
  description->cStencilBits = channel;
  return 1;
}

template <typename Function>
void* pointer(Function* function) {
  return reinterpret_cast<void*>(function);
}

// The function that GLFW or Penumbra calls by this name: null for functions of WGL's that the
// library does not have.
void* find_function(char const* name);

void* wgl_function(std::string_view name) {
  static std::array<std::pair<std::string_view, void*>, 11> const functions{{
      {"wglCreateContext", pointer(&create_context)},
      {"wglDeleteContext", pointer(&delete_context)},
      {"wglMakeCurrent", pointer(&make_current)},
      {"wglGetCurrentContext", pointer(&get_current_context)},
      {"wglGetCurrentDC", pointer(&get_current_device)},
      {"wglShareLists", pointer(&succeed)},
      {"wglChoosePixelFormat", pointer(&succeed)},
      {"wglGetPixelFormat", pointer(&succeed)},
      {"wglSetPixelFormat", pointer(&succeed)},
      {"wglSwapBuffers", pointer(&succeed)},
      {"wglDescribePixelFormat", pointer(&describe_pixel_format)},
  }};
  if (name == "wglGetProcAddress") return pointer(&find_function);
  for (auto const& [known, function] : functions) {
    if (known == name) return function;
  }
  return nullptr;
}

void* find_function(char const* name) {
  return std::string_view(name).starts_with("wgl") ? wgl_function(name) : opengl_function(name);
}

// A function of OpenGL that changes nothing here.
long long nothing() { return 0; }

// EnergyPlus has loaded this library, or will not draw anything else. Other programs beside whose
// files it may lie have OpenGL as they would without it.
bool in_energyplus() {
  static bool const is = GetModuleHandleA("energyplusapi.dll") != nullptr;
  return is;
}

HMODULE load() {
  std::wstring path(MAX_PATH, L'\0');
  path.resize(GetSystemDirectoryW(path.data(), static_cast<UINT>(path.size())));
  return LoadLibraryW((path + L"\\opengl32.dll").c_str());
}

// A function of Windows's own opengl32.dll; null if it has none of that name.
void* system_function(char const* name) {
  static HMODULE const library = load();
  return library == nullptr ? nullptr : reinterpret_cast<void*>(GetProcAddress(library, name));
}

}  // namespace
}  // namespace gpu_shading::energyplus

void* gpu_shading_find_entry(int index) {
  using namespace gpu_shading::energyplus;
  char const* const name = gpu_shading_entry_names[index];
  void* found = in_energyplus() ? find_function(name) : system_function(name);
  if (found == nullptr) found = reinterpret_cast<void*>(&nothing);
  gpu_shading_entry_table[index] = found;
  return found;
}
