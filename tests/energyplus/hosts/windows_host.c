/* host.exe ENERGYPLUS-FOLDER ARGUMENT...: runs EnergyPlus within this program, which lies
 * elsewhere, as python.exe does: our library is loaded by its path, so that EnergyPlus gets it when
 * it loads OpenGL by name. */
#include <stdio.h>
#include <wchar.h>
#include <windows.h>

enum { most_bytes = 4096, most_words = 32 };

static FARPROC find(HMODULE library, char const* name) {
  FARPROC const found = GetProcAddress(library, name);
  if (!found) fprintf(stderr, "no function %s\n", name);
  return found;
}

static HMODULE load(wchar_t const* folder, wchar_t const* name) {
  wchar_t path[MAX_PATH];
  _snwprintf(path, MAX_PATH, L"%ls\\%ls", folder, name);
  HMODULE const library = LoadLibraryExW(path, NULL, LOAD_WITH_ALTERED_SEARCH_PATH);
  if (!library) fprintf(stderr, "%ls cannot be loaded\n", path);
  return library;
}

int wmain(int argc, wchar_t** argv) {
  static char words[most_words][most_bytes] = {"energyplus"};
  char const* arguments[most_words] = {words[0]};
  if (argc < 2 || argc > most_words) return 2;
  for (int i = 1; i < argc; ++i) {
    WideCharToMultiByte(CP_UTF8, 0, argv[i], -1, words[i], most_bytes, NULL, NULL);
    if (i > 1) arguments[i - 1] = words[i];
  }
  HMODULE const ours = load(argv[1], L"opengl32.dll");
  HMODULE const energyplus = load(argv[1], L"energyplusapi.dll");
  if (!ours || !energyplus) return 2;
  void* (*const new_state)(void) = (void* (*)(void))(void*)find(energyplus, "stateNew");
  void (*const set_root)(void*, char const*) =
      (void (*)(void*, char const*))(void*)find(energyplus, "setEnergyPlusRootDirectory");
  int (*const run)(void*, int, char const**) =
      (int (*)(void*, int, char const**))(void*)find(energyplus, "energyplus");
  if (!new_state || !set_root || !run) return 2;
  void* const state = new_state();
  set_root(state, words[1]);
  return run(state, argc - 1, arguments);
}
