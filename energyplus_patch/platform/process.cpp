#include "platform/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>

#include "platform/ending_signals.h"
#include "platform/file_descriptor.h"
#include "platform/text.h"

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

[[noreturn]] void fail_to_run(std::string_view program, int error) {
  throw Error(fmt::format("{}: cannot be run ({})", program, std::strerror(error)));
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  result.reserve(strings.size() + 1);
  for (auto& string : strings) result.push_back(string.data());
  result.push_back(nullptr);
  return result;
}

struct Start {
  char* const* words;
  char* const* variables;
  char const* output;
  char const* folder;
  sigset_t const& signals;
};

// Becomes the program, in a process that has just been forked: only system calls. Returns with
// errno if that fails.
void become(Start const& program, pid_t parent) {
  // It ends with its parent, which may have ended already.
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) return;
  if (getppid() != parent) _exit(signal_base + SIGKILL);
  constexpr mode_t permissions = 0644;
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  int const output = open(program.output, O_WRONLY | O_CREAT | O_TRUNC, permissions);
  if (output < 0 || dup2(output, STDOUT_FILENO) < 0 || dup2(output, STDERR_FILENO) < 0) return;
  if (output > STDERR_FILENO) close(output);
  if (sigprocmask(SIG_SETMASK, &program.signals, nullptr) != 0) return;
  if (takes_file_limit_as_error() && signal(SIGXFSZ, SIG_DFL) == SIG_ERR) return;
  if (*program.folder != '\0' && chdir(program.folder) != 0) return;
  execve(program.words[0], program.words, program.variables);
}

pid_t start(Start const& program) {
  // Where the child says why it could not become the program; closed by the kernel if it could.
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_run(program.words[0], errno);
  FileDescriptor const heard(ends[0]);
  std::optional<FileDescriptor> said(ends[1]);
  pid_t const parent = getpid();
  pid_t const child = fork();
  if (child < 0) fail_to_run(program.words[0], errno);
  if (child == 0) {
    become(program, parent);
    int const error = errno;
    constexpr int not_run = 127;
    _exit(write(ends[1], &error, sizeof error) == sizeof error ? not_run : not_run - 1);
  }
  said.reset();
  int error = 0;
  ssize_t count = 0;
  while ((count = read(heard.get(), &error, sizeof error)) < 0 && errno == EINTR) {
  }
  if (count == 0) return child;
  waitpid(child, nullptr, 0);
  fail_to_run(program.words[0], error);
}

std::filesystem::path find_temporary_files() {
  try {
    return std::filesystem::temp_directory_path();
  } catch (std::filesystem::filesystem_error const& error) {
    // As they are looked up.
    for (char const* const name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {
      auto const folder = get_variable(name);
      if (folder.empty()) continue;
      throw Error(fmt::format("{} is {}, expected a folder for temporary files ({})", name,
                              in_quotes(folder), error.code().message()));
    }
    throw;
  }
}

}  // namespace

std::vector<std::string> arguments_of(int argc, char const* const* argv) {
  return {argv + 1, argv + argc};
}

void occupy_standard_descriptors() {
  for (int const descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    // It gets the lowest number that is free.
    open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

std::filesystem::path own_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

TemporaryFolder::TemporaryFolder()
    : folder_(find_temporary_files(), prefix), path_(folder_.path() / "files") {
  std::filesystem::create_directory(path_);
}

std::string get_variable(char const* name) {
  char const* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

void set_variable(char const* name, std::string const& value) { setenv(name, value.c_str(), 1); }

int run_process(std::vector<std::string> const& command,
                std::vector<std::string> const& environment, std::filesystem::path const& output,
                std::filesystem::path const& folder) {
  auto words = command;
  auto variables = environment;
  for (char** variable = environ; *variable != nullptr; ++variable)
    variables.emplace_back(*variable);
  auto const argv = pointers(words);
  auto const envp = pointers(variables);

  HeldSignals const signals;
  pid_t const child =
      start({argv.data(), envp.data(), output.c_str(), folder.c_str(), signals.before()});
  ProcessAtSignals const ends_with_us(child);
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

std::string describe_lack_of_memory() {
  constexpr std::uint64_t mib = std::uint64_t{1} << 20U;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  auto const used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / mib;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return fmt::format("out of memory, with {} MiB of addresses in use", used);
  }
  constexpr int needed = 300;  // of small models
  return fmt::format(
      "out of memory: ulimit -v allows {} MiB of addresses, of which {} are in use; a small model "
      "needs {}",
      limit.rlim_cur / mib, used, needed);
}

}  // namespace gpu_shading::energyplus
