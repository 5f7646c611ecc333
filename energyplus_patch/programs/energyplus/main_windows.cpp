// energyplus.exe: runs the official program or, with --gpu-shading, EnergyPlus's library in this
// process with our opengl32.dll, which is in the same folder and does the work.

#include <windows.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

constexpr wchar_t const* official_program = L"energyplus-official.exe";
constexpr wchar_t const* library = L"opengl32.dll";
constexpr int not_wanted = -1;

using RunEnergyPlus = int(int count, char const* const* arguments);

std::wstring own_folder() {
  constexpr DWORD max_length = 32768;
  std::wstring path(max_length, L'\0');
  path.resize(GetModuleFileNameW(nullptr, path.data(), max_length));
  return path.substr(0, path.find_last_of(L'\\') + 1);
}

std::string to_utf8(wchar_t const* text) {
  int const size = WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  std::string utf8(static_cast<std::size_t>(size), '\0');
  WideCharToMultiByte(CP_UTF8, 0, text, -1, utf8.data(), size, nullptr, nullptr);
  utf8.pop_back();
  return utf8;
}

int fail(wchar_t const* file) {
  std::fprintf(stderr, "gpu_shading: error: %s: cannot be run (error %lu)\n", to_utf8(file).c_str(),
               GetLastError());
  return EXIT_FAILURE;
}

// With the same command line, after the program's name.
int run_official() {
  auto const program = own_folder() + official_program;
  wchar_t const* rest = GetCommandLineW();
  bool quoted = false;
  for (; *rest != L'\0' && (quoted || (*rest != L' ' && *rest != L'\t')); ++rest) {
    if (*rest == L'"') quoted = !quoted;
  }
  std::wstring line = L'"' + program + L'"' + rest;
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  PROCESS_INFORMATION started{};
  if (CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr,
                     &startup, &started) == 0) {
    return fail(official_program);
  }
  WaitForSingleObject(started.hProcess, INFINITE);
  DWORD status = 0;
  GetExitCodeProcess(started.hProcess, &status);
  CloseHandle(started.hThread);
  CloseHandle(started.hProcess);
  return static_cast<int>(status);
}

}  // namespace

extern "C" int wmain(int argc, wchar_t** argv) {
  HMODULE const loaded =
      LoadLibraryExW((own_folder() + library).c_str(), nullptr, LOAD_WITH_ALTERED_SEARCH_PATH);
  if (loaded == nullptr) return fail(library);
  auto* const run = reinterpret_cast<RunEnergyPlus*>(
      reinterpret_cast<void*>(GetProcAddress(loaded, "gpu_shading_energyplus")));
  if (run == nullptr) return fail(library);
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) arguments.push_back(to_utf8(argv[i]));
  std::vector<char const*> words;
  words.reserve(arguments.size());
  for (auto const& argument : arguments) words.push_back(argument.c_str());
  int const status = run(static_cast<int>(words.size()), words.data());
  return status == not_wanted ? run_official() : status;
}
