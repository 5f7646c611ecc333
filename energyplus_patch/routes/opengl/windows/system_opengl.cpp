#include "routes/opengl/windows/system_opengl.h"

#include <windows.h>

#include <string>

namespace gpu_shading::energyplus {
namespace {

HMODULE load() {
  std::wstring path(MAX_PATH, L'\0');
  path.resize(GetSystemDirectoryW(path.data(), static_cast<UINT>(path.size())));
  return LoadLibraryW((path + L"\\opengl32.dll").c_str());
}

}  // namespace

void* system_function(char const* name) {
  static HMODULE const library = load();
  return library == nullptr ? nullptr : reinterpret_cast<void*>(GetProcAddress(library, name));
}

}  // namespace gpu_shading::energyplus
