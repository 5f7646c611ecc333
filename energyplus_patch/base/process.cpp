#include "base/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "base/file_descriptor.h"
#include "base/files.h"

namespace gpu_shading::energyplus {

namespace {

constexpr int signal_base = 128;

// Holds back, in this thread, the signals that ask a program to end, unless they are ignored.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (int const signal : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction action {};
      if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) {
        sigaddset(&held_, signal);
      }
    }
    pthread_sigmask(SIG_BLOCK, &held_, &before_);
  }
  HeldSignals(HeldSignals const&) = delete;
  HeldSignals& operator=(HeldSignals const&) = delete;
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

  sigset_t const& held() const { return held_; }
  sigset_t const& before() const { return before_; }

 private:
  sigset_t held_{};
  sigset_t before_{};
};

// Passes signals on to a child until it ends. Returns the last one, or 0.
int pass_signals_on(pid_t child, sigset_t const& signals) {
  FileDescriptor const ended(static_cast<int>(syscall(SYS_pidfd_open, child, 0)));
  FileDescriptor const arrived(signalfd(-1, &signals, SFD_CLOEXEC));
  if (ended.get() < 0 || arrived.get() < 0) return 0;  // a kernel before 5.3
  int last = 0;
  std::array<pollfd, 2> watched{{{ended.get(), POLLIN, 0}, {arrived.get(), POLLIN, 0}}};
  while (true) {
    if (poll(watched.data(), watched.size(), -1) < 0) {
      if (errno == EINTR) continue;
      return last;
    }
    if ((watched[0].revents & POLLIN) != 0) return last;
    signalfd_siginfo signal{};
    if ((watched[1].revents & POLLIN) == 0) continue;
    if (read(arrived.get(), &signal, sizeof signal) != sizeof signal) continue;
    last = static_cast<int>(signal.ssi_signo);
    kill(child, last);
  }
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  result.reserve(strings.size() + 1);
  for (auto& string : strings) result.push_back(string.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

std::filesystem::path own_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

TemporaryFolder::TemporaryFolder() {
  auto name = (std::filesystem::temp_directory_path() / "gpu_shading_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw Error(fmt::format("{}: {}", name, std::strerror(errno)));
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void require_room(std::filesystem::path const& folder) {
  constexpr std::size_t bytes = 4096;
  write_whole_file(folder / "room.txt", [](std::ostream& out) { out << std::string(bytes, '.'); });
}

int run_process(std::vector<std::string> const& command,
                std::vector<std::string> const& environment, std::filesystem::path const& output) {
  auto words = command;
  auto variables = environment;
  for (char** variable = environ; *variable != nullptr; ++variable)
    variables.emplace_back(*variable);
  auto const argv = pointers(words);
  auto const envp = pointers(variables);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr mode_t permissions = 0644;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, permissions);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  HeldSignals const signals;
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &signals.before());
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = 0;
  int const failure = posix_spawn(&child, argv[0], &actions, &attributes, argv.data(), envp.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw Error(fmt::format("{}: {}", command.front(), std::strerror(failure)));

  int const interrupted = pass_signals_on(child, signals.held());
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (interrupted != 0) throw Interrupted(interrupted);
  return WIFEXITED(status) ? WEXITSTATUS(status) : signal_base + WTERMSIG(status);
}

std::string describe_status(int status) {
  if (status <= signal_base) return fmt::format("exit status {}", status);
  int const signal = status - signal_base;
  return fmt::format("ended by signal {} ({})", signal, strsignal(signal));
}

Interrupted::Interrupted(int signal)
    : Error(fmt::format("interrupted by signal {} ({})", signal, strsignal(signal))),
      signal_(signal) {}

void Interrupted::raise() const {
  signal(signal_, SIG_DFL);
  ::raise(signal_);
}

}  // namespace gpu_shading::energyplus
