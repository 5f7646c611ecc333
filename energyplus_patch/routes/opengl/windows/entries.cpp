#include "routes/opengl/windows/entries.h"

#include <windows.h>

#include <string>

#include "routes/opengl/windows/wgl_functions.h"

namespace gpu_shading::energyplus {
namespace {

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
