#include "platform/ending_signals.h"

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string_view>

namespace gpu_shading::energyplus {

// Fixed memory, which a signal handler may read at any time.
struct EndingRegistry {
  struct Folder {
    std::atomic<bool> taken = false;
    std::atomic<bool> complete = false;  // the path
    std::atomic<bool> made = false;
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
    if (!folder.complete) continue;
    if (folder.made) {
      delete_folder(folder.path.data());
    } else {
      rmdir(folder.path.data());
    }
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
    folders[i].made = false;
    folders[i].complete = true;
    slot_ = i;
    return;
  }
}

void FolderAtSignals::is_made() noexcept {
  if (slot_ != no_slot) ending_registry().folders.at(slot_).made = true;
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

namespace {

// Entries as the kernel gives them; readdir() allocates memory.
class Entries {
 public:
  explicit Entries(int folder) : folder_(folder) {}

  // The next name, or nullptr at the end.
  char const* next() noexcept {
    if (at_ >= size_) {
      size_ = syscall(SYS_getdents64, folder_, bytes_.data(), bytes_.size());
      at_ = 0;
      if (size_ <= 0) return nullptr;
    }
    auto const* const entry = reinterpret_cast<dirent64 const*>(bytes_.data() + at_);
    at_ += entry->d_reclen;
    return static_cast<char const*>(entry->d_name);
  }

 private:
  alignas(dirent64) std::array<char, 4096> bytes_{};
  long at_ = 0;
  long size_ = 0;
  int folder_;
};

// A path that is longer and shorter by a name.
class DeepPath {
 public:
  explicit DeepPath(char const* root) noexcept : root_(std::strlen(root)), length_(root_) {
    if (length_ < path_.size()) std::memcpy(path_.data(), root, length_ + 1);
  }

  bool fits() const noexcept { return length_ < path_.size(); }
  bool is_root() const noexcept { return length_ == root_; }
  char const* text() const noexcept { return path_.data(); }

  bool descend(std::string_view name) noexcept {
    if (length_ + 1 + name.size() >= path_.size()) return false;
    path_[length_] = '/';
    std::memcpy(path_.data() + length_ + 1, name.data(), name.size());
    length_ += 1 + name.size();
    path_[length_] = '\0';
    return true;
  }
  void ascend() noexcept {
    while (path_[length_] != '/') --length_;
    path_[length_] = '\0';
  }

 private:
  std::array<char, PATH_MAX> path_{};
  std::size_t root_;
  std::size_t length_;
};

// Deletes what is directly in a folder. Returns false if the path now leads to a folder in it that
// has to be emptied first.
bool empty(int folder, DeepPath& path) noexcept {
  Entries entries(folder);
  while (char const* const name = entries.next()) {
    if (std::string_view(name) == "." || std::string_view(name) == "..") continue;
    if (unlinkat(folder, name, 0) == 0 || errno == ENOENT) continue;
    if (unlinkat(folder, name, AT_REMOVEDIR) == 0) continue;
    if ((errno == ENOTEMPTY || errno == EEXIST) && path.descend(name)) return false;
  }
  return true;
}

}  // namespace

bool delete_folder(char const* root) noexcept {
  DeepPath path(root);
  if (!path.fits()) return false;
  for (int failures = 0; failures < 100;) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
    int const folder = open(path.text(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder >= 0) {
      bool const emptied = empty(folder, path);
      close(folder);
      if (!emptied) continue;
    }
    if (rmdir(path.text()) != 0 && errno != ENOENT) {
      ++failures;
      continue;
    }
    if (path.is_root()) return true;
    path.ascend();
  }
  return false;
}

}  // namespace gpu_shading::energyplus
