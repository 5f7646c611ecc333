#include "files/decoding_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

#include "files/decoding/decoded_message.h"
#include "files/decoding/decoder.h"
#include "files/sibling_file.h"
#include "gpu_shading/error.h"
#include "platform/file_descriptor.h"

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] void throw_errno(char const* what) {
  throw Error(fmt::format("{}: {}", what, std::strerror(errno)));
}

// What posix_spawn() is to do besides.
class Spawning {
 public:
  Spawning() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  Spawning(Spawning const&) = delete;
  Spawning& operator=(Spawning const&) = delete;
  ~Spawning() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  void give(int descriptor, int as) { posix_spawn_file_actions_adddup2(&actions_, descriptor, as); }

  // Returns an errno value.
  int start(pid_t& process, std::vector<std::string> words, std::vector<std::string> variables) {
    auto const arguments = pointers(words);
    auto const environment = pointers(variables);
    return posix_spawn(&process, arguments.front(), &actions_, &attributes_, arguments.data(),
                       environment.data());
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> all;
    all.reserve(words.size() + 1);
    for (auto& word : words) all.push_back(word.data());
    all.push_back(nullptr);
    return all;
  }

  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

// This process's variables. Assimp fills a buffer of 16 MiB for each file, which in small pages
// takes longer than most files. Users of other allocators lose nothing.
std::vector<std::string> with_huge_pages() {
  constexpr std::string_view name = "GLIBC_TUNABLES=";
  std::string tunables(name);
  std::vector<std::string> variables;
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
    std::string_view const text(*variable);
    if (text.starts_with(name)) {
      tunables = std::string(text) + ':';
    } else {
      variables.emplace_back(text);
    }
  }
  variables.push_back(tunables + "glibc.malloc.hugetlb=1");
  return variables;
}

// What the system says of a program that could not be loaded or crashed, in a line.
std::string summary_of(std::string_view said) {
  constexpr std::string_view cause = "what():";
  auto const found = said.find(cause);
  if (found != std::string_view::npos) said.remove_prefix(found + cause.size());
  said = said.substr(0, said.find('\n'));
  said.remove_prefix(std::min(said.size(), said.find_first_not_of(' ')));
  return said.empty() ? std::string() : fmt::format(": {}", said);
}

// For a program that has not started: its libraries need addresses.
std::string limit_of_memory() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  constexpr unsigned mebibyte = 20;
  constexpr int needed = 600;  // of small images
  return fmt::format("; ulimit -v allows {} MiB of addresses, and decoding needs {}",
                     limit.rlim_cur >> mebibyte, needed);
}

// A descriptor that is none of the standard ones, which it may have got where a host has closed
// them.
int beyond_standard(int descriptor) {
  FileDescriptor const given(descriptor);
  return given.is_open() ? fcntl(given.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1) : -1;
}

// A decoding program that waits for requests. Its children are this thread's, and end with it: one
// thread's server is of no use to another.
class Server {
 public:
  explicit Server(std::filesystem::path const& program)
      : errors_(beyond_standard(memfd_create("errors", MFD_CLOEXEC))) {
    std::array<int, 2> ends{-1, -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw_errno("no socket for its decoding");
    }
    link_.emplace(ends[0]);
    FileDescriptor const other(beyond_standard(ends[1]));
    Spawning spawning;
    spawning.give(other.get(), STDIN_FILENO);
    spawning.give(errors_.get(), STDOUT_FILENO);
    spawning.give(errors_.get(), STDERR_FILENO);
    int const failure = spawning.start(process_, {program.string()}, with_huge_pages());
    if (failure != 0) {
      process_ = -1;
      throw Error(fmt::format("cannot be decoded without {}: {}{}", program.string(),
                              std::strerror(failure), formats_package(program)));
    }
  }
  Server(Server const&) = delete;
  Server& operator=(Server const&) = delete;
  ~Server() {
    if (is_ours()) end();
  }

  // Whether this process started it, and is not a fork of the one that did.
  bool is_ours() const { return owner_ == getpid() && process_ > 0; }

  // The number of the new process; nothing if the server has ended. Throws Error, and ends the
  // server, if it does not reply in time.
  std::optional<pid_t> start(std::vector<std::string> const& words, int input, int output,
                             DecodingDeadline const& deadline) {
    if (!ask(words, input, output)) return std::nullopt;
    pollfd watched{link_->get(), POLLIN, 0};
    int ready = 0;
    do {
      ready = poll(&watched, 1, deadline.milliseconds_left());
    } while (ready < 0 && errno == EINTR);
    if (ready == 0) {
      end();
      deadline.fail();
    }
    std::int32_t reply = 0;
    auto const got = recv(link_->get(), &reply, sizeof reply, MSG_DONTWAIT);
    if (got != sizeof reply) return std::nullopt;
    if (reply <= 0) throw Error("no process for its decoding");
    return reply;
  }

  // Why it ended.
  std::string reason() {
    std::array<char, decoding::max_message_bytes> text{};
    int const status = end();
    // What the system says if a library is missing.
    auto const length = pread(errors_.get(), text.data(), text.size(), 0);
    std::string_view const said(text.data(),
                                static_cast<std::size_t>(std::max<ssize_t>(0, length)));
    return fmt::format("the program that decodes it {} {}{}{}",
                       WIFSIGNALED(status) ? "was ended by signal" : "ended with status",
                       WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status),
                       summary_of(said), limit_of_memory());
  }

 private:
  bool ask(std::vector<std::string> const& words, int input, int output) const {
    std::string bytes;
    for (auto const& word : words) bytes.append(word).push_back('\0');
    if (bytes.size() > decoding::max_request_bytes) throw Error("its name is too long");
    std::array<int, 2> const descriptors{input, output};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof descriptors)> control{};
    iovec part{bytes.data(), bytes.size()};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    auto* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof descriptors);
    std::memcpy(CMSG_DATA(header), descriptors.data(), sizeof descriptors);
    ssize_t sent = 0;
    do {
      sent = sendmsg(link_->get(), &message, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent == static_cast<ssize_t>(bytes.size());
  }

  int end() {
    int status = 0;
    // It lives if it still has its end of the link. It has nothing to finish, and may be stopped.
    pollfd watched{link_->get(), 0, 0};
    if (process_ > 0 && poll(&watched, 1, 0) == 0) kill(process_, SIGKILL);
    while (process_ > 0 && waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

  pid_t owner_ = getpid();
  FileDescriptor errors_;
  std::optional<FileDescriptor> link_;
  pid_t process_ = -1;
};

}  // namespace

DecodingDeadline::DecodingDeadline(std::chrono::seconds wait)
    : wait_(wait), end_(std::chrono::steady_clock::now() + wait) {}

bool DecodingDeadline::is_over() const { return std::chrono::steady_clock::now() > end_; }

int DecodingDeadline::milliseconds_left() const {
  auto const left =
      std::chrono::ceil<std::chrono::milliseconds>(end_ - std::chrono::steady_clock::now());
  return static_cast<int>(std::max<std::int64_t>(0, left.count()));
}

void DecodingDeadline::fail() const {
  throw Error(fmt::format("it takes more than {} s", wait_.count()));
}

pid_t start_decoding(char const* program, std::vector<std::string> const& words, int input,
                     int output, DecodingDeadline const& deadline) {
  thread_local std::map<std::string, Server> servers;
  auto const path = sibling_file(program);
  auto known = servers.find(path);
  if (known != servers.end()) {
    if (known->second.is_ours()) {
      if (auto const process = known->second.start(words, input, output, deadline)) return *process;
    }
    // It waited too long and ended, or is another process's.
    servers.erase(known);
  }
  auto& server = servers.try_emplace(path, path).first->second;
  if (auto const process = server.start(words, input, output, deadline)) return *process;
  auto const why = server.reason();
  servers.erase(path);
  throw Error(why);
}

}  // namespace gpu_shading::energyplus
