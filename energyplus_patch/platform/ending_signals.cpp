#include "platform/ending_signals.h"

#include <dlfcn.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string>

#include "platform/folder_deletion.h"

namespace gpu_shading::energyplus {

// Fixed memory, which a signal handler may read at any time.
struct EndingRegistry {
  struct Folder {
    std::atomic<bool> taken = false;
    std::atomic<bool> complete = false;
    std::array<char, PATH_MAX> path{};
  };

  // Written by main() alone. A process that is forked from it has the same handlers but other
  // folders.
  std::atomic<pid_t> owner = 0;
  std::array<Folder, 64> folders;
  std::array<std::atomic<pid_t>, 64> processes{};
};

}  // namespace gpu_shading::energyplus

// A program exports it to libraries that have this code too (export_ending_registry() of CMake).
extern "C" __attribute__((visibility("default")))
gpu_shading::energyplus::EndingRegistry gpu_shading_ending_registry;
gpu_shading::energyplus::EndingRegistry gpu_shading_ending_registry;

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t no_slot = static_cast<std::size_t>(-1);

EndingRegistry& ending_registry() noexcept {
  static auto* const of_program =
      static_cast<EndingRegistry*>(dlsym(RTLD_DEFAULT, "gpu_shading_ending_registry"));
  return of_program != nullptr ? *of_program : gpu_shading_ending_registry;
}

// Returns whether it has ended. It stays for the thread that waits for it.
bool wait_for_end(pid_t process, int milliseconds) noexcept {
  constexpr timespec millisecond{0, 1'000'000};
  for (int i = 0; i < milliseconds; ++i) {
    siginfo_t ended{};
    int const waited =
        waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (waited != 0 || ended.si_pid == process) return true;
    nanosleep(&millisecond, nullptr);
  }
  return false;
}

// It may have folders of its own to delete.
void end_process(pid_t process) noexcept {
  constexpr int patience = 2000;
  kill(process, SIGTERM);
  if (wait_for_end(process, patience)) return;
  kill(process, SIGKILL);
  wait_for_end(process, patience);
}

void clean_up_and_end(int signal) {
  int const error = errno;
  clean_up_now();
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  sigaction(signal, &usual, nullptr);
  raise(signal);
  errno = error;
}

std::atomic<bool> file_limit_is_error = false;

}  // namespace

void clean_up_at_signals() {
  auto& all = ending_registry();
  // What a process that forked this one has begun is that one's to end.
  for (auto& folder : all.folders) folder.complete = false;
  for (auto& process : all.processes) process = 0;
  all.owner = getpid();
  for (int const signal : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGALRM, SIGTERM, SIGXCPU, SIGXFSZ,
                           SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = clean_up_and_end;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

void clean_up_now() noexcept {
  auto& all = ending_registry();
  if (all.owner != getpid()) return;
  for (auto const& process : all.processes) {
    if (pid_t const id = process; id > 0) end_process(id);
  }
  for (auto const& folder : all.folders) {
    if (folder.complete) delete_folder(folder.path.data());
  }
}

void take_file_limit_as_error() {
  struct sigaction before {};
  if (sigaction(SIGXFSZ, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
  file_limit_is_error = signal(SIGXFSZ, SIG_IGN) != SIG_ERR;
}

bool takes_file_limit_as_error() noexcept { return file_limit_is_error; }

FolderAtSignals::FolderAtSignals(std::filesystem::path const& folder) : slot_(no_slot) {
  // The current folder may be another one when the signal comes.
  auto const path = std::filesystem::absolute(folder).string();
  auto& folders = ending_registry().folders;
  if (path.size() >= folders[0].path.size()) return;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    if (folders[i].taken.exchange(true)) continue;
    std::memcpy(folders[i].path.data(), path.c_str(), path.size() + 1);
    folders[i].complete = true;
    slot_ = i;
    return;
  }
}

FolderAtSignals::~FolderAtSignals() {
  if (slot_ == no_slot) return;
  auto& folder = ending_registry().folders.at(slot_);
  folder.complete = false;
  folder.taken = false;
}

ProcessAtSignals::ProcessAtSignals(int process) : slot_(no_slot) {
  auto& processes = ending_registry().processes;
  for (std::size_t i = 0; i < processes.size(); ++i) {
    pid_t none = 0;
    if (!processes[i].compare_exchange_strong(none, process)) continue;
    slot_ = i;
    return;
  }
}

ProcessAtSignals::~ProcessAtSignals() {
  if (slot_ != no_slot) ending_registry().processes.at(slot_) = 0;
}

}  // namespace gpu_shading::energyplus
