#include <fmt/format.h>
#include <shellapi.h>
#include <windows.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "platform/process.h"
#include "platform/wide_text.h"

namespace gpu_shading::energyplus {
namespace {

// Closes a handle with the object.
using Handle = std::unique_ptr<void, decltype(&CloseHandle)>;

[[noreturn]] void fail(std::string const& program) {
  std::error_code const why(static_cast<int>(GetLastError()), std::system_category());
  throw Error(fmt::format("{}: cannot be run ({})", program, why.message()));
}

// As Windows's programs read words from a command line.
std::wstring quoted(std::wstring const& word) {
  std::wstring text = L"\"";
  std::size_t slashes = 0;
  for (wchar_t const c : word) {
    if (c == L'"') text.append(slashes + 1, L'\\');
    slashes = c == L'\\' ? slashes + 1 : 0;
    text += c;
  }
  return text.append(slashes, L'\\') + L'"';
}

// Ours with further variables, which come first: the first of a name counts.
std::wstring environment_with(std::vector<std::string> const& further) {
  std::wstring block;
  auto const name = [](std::wstring_view variable) {
    return variable.substr(0, variable.find(L'='));
  };
  std::vector<std::wstring> added;
  for (auto const& variable : further) added.push_back(to_wide(variable));
  for (auto const& variable : added) block += variable + L'\0';
  wchar_t* const ours = GetEnvironmentStringsW();
  for (wchar_t const* at = ours; *at != L'\0'; at += std::wstring_view(at).size() + 1) {
    bool replaced = false;
    for (auto const& variable : added) replaced = replaced || name(variable) == name(at);
    if (!replaced) (block += at) += L'\0';
  }
  FreeEnvironmentStringsW(ours);
  return block + L'\0';
}

}  // namespace

// What main() is given is in the system's code page.
std::vector<std::string> arguments_of(int /*argc*/, char const* const* /*argv*/) {
  int count = 0;
  std::unique_ptr<wchar_t*, decltype(&LocalFree)> const words(
      CommandLineToArgvW(GetCommandLineW(), &count), &LocalFree);
  std::vector<std::string> arguments;
  for (int i = 1; i < count; ++i) arguments.push_back(to_utf8(words.get()[i]));
  return arguments;
}

void occupy_standard_descriptors() {}  // their numbers are given to no other file here

std::filesystem::path own_folder() {
  constexpr DWORD max_length = 32768;
  std::wstring path(max_length, L'\0');
  path.resize(GetModuleFileNameW(nullptr, path.data(), max_length));
  return std::filesystem::path(path).parent_path();
}

TemporaryFolder::TemporaryFolder()
    : folder_(std::filesystem::temp_directory_path(), prefix), path_(folder_.path() / "files") {
  std::filesystem::create_directory(path_);
}

std::string get_variable(char const* name) {
  wchar_t const* const value = _wgetenv(to_wide(name).c_str());
  return value == nullptr ? "" : to_utf8(value);
}

void set_variable(char const* name, std::string const& value) {
  _wputenv_s(to_wide(name).c_str(), to_wide(value).c_str());
}

int run_process(std::vector<std::string> const& command,
                std::vector<std::string> const& environment, std::filesystem::path const& output,
                std::filesystem::path const& folder) {
  std::wstring line;
  for (auto const& word : command) line += quoted(to_wide(word)) + L' ';
  auto block = environment_with(environment);
  SECURITY_ATTRIBUTES inherited{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
  Handle const log(CreateFileW(output.c_str(), GENERIC_WRITE, FILE_SHARE_READ, &inherited,
                               CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr),
                   &CloseHandle);
  if (log.get() == INVALID_HANDLE_VALUE) fail(output.string());
  // It ends with its parent.
  Handle const job(CreateJobObjectW(nullptr, nullptr), &CloseHandle);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = GetStdHandle(STD_INPUT_HANDLE);
  startup.hStdOutput = log.get();
  startup.hStdError = log.get();
  PROCESS_INFORMATION started{};
  constexpr DWORD flags = CREATE_UNICODE_ENVIRONMENT | CREATE_SUSPENDED;
  if (CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, flags, block.data(),
                     folder.empty() ? nullptr : folder.c_str(), &startup, &started) == 0) {
    fail(command.front());
  }
  Handle const process(started.hProcess, &CloseHandle);
  Handle const thread(started.hThread, &CloseHandle);
  AssignProcessToJobObject(job.get(), process.get());
  ResumeThread(thread.get());
  WaitForSingleObject(process.get(), INFINITE);
  DWORD status = 0;
  GetExitCodeProcess(process.get(), &status);
  return static_cast<int>(status);
}

std::string describe_status(int status) { return fmt::format("exit status {}", status); }

Interrupted::Interrupted(int signal)
    : Error(fmt::format("interrupted by signal {}", signal)), signal_(signal) {}

void Interrupted::raise() const {
  std::signal(signal_, SIG_DFL);
  std::raise(signal_);
}

std::string describe_lack_of_memory() { return "out of memory"; }

}  // namespace gpu_shading::energyplus
