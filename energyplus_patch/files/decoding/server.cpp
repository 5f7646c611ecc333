#include "files/decoding/server.h"

#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

namespace gpu_shading::decoding {
namespace {

constexpr int link = STDIN_FILENO;
constexpr int patience = 30'000;  // ms

struct Received {
  std::vector<std::string> words;
  std::array<int, 2> descriptors{};
};

std::vector<std::string> words_of(char const* bytes, std::size_t count) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < count; at += words.back().size() + 1) {
    words.emplace_back(bytes + at, strnlen(bytes + at, count - at));
  }
  return words;
}

// Nothing at the end, or if what came is no request.
std::optional<Received> receive() {
  pollfd watched{link, POLLIN, 0};
  if (poll(&watched, 1, patience) != 1) return std::nullopt;
  std::array<char, longest_request> bytes{};
  Received received;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof received.descriptors)> control{};
  iovec part{bytes.data(), bytes.size()};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  auto const count = recvmsg(link, &message, MSG_CMSG_CLOEXEC);
  auto const* const header = CMSG_FIRSTHDR(&message);
  if (count <= 0 || header == nullptr || header->cmsg_type != SCM_RIGHTS ||
      header->cmsg_len != CMSG_LEN(sizeof received.descriptors)) {
    return std::nullopt;
  }
  std::memcpy(received.descriptors.data(), CMSG_DATA(header), sizeof received.descriptors);
  received.words = words_of(bytes.data(), static_cast<std::size_t>(count));
  return received;
}

// The state of each other thread, and how often it has gone to sleep.
std::string other_threads() {
  std::string all;
  auto const self = std::to_string(getpid());
  for (auto const& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    if (entry.path().filename() == self) continue;
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("State:") || line.starts_with("voluntary")) all += line;
    }
  }
  return all;
}

// Libraries start threads as they are loaded. A fork while one of them holds a lock, as of malloc,
// would find it locked for ever; once all sleep, nobody wakes them. One that never sleeps is not
// waited for.
void wait_for_other_threads() {
  constexpr int most = 1000;
  for (int i = 0; i < most; ++i) {
    auto const before = other_threads();
    usleep(1000);
    auto const now = other_threads();
    if (now == before && now.find("(running)") == std::string::npos &&
        now.find("(disk sleep)") == std::string::npos) {
      return;
    }
  }
}

// A copy of this thread's process, without other threads, as a child of its parent.
pid_t fork_sibling() {
  return static_cast<pid_t>(
      syscall(SYS_clone, CLONE_PARENT | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

}  // namespace

int serve(std::function<int(std::vector<std::string> const&)> const& decode) {
  wait_for_other_threads();
  while (auto const request = receive()) {
    auto const process = fork_sibling();
    auto const [input, output] = request->descriptors;
    if (process == 0) {
      // The end of the link is closed with that.
      if (dup2(input, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0) return EXIT_FAILURE;
      close(input);
      close(output);
      return decode(request->words);
    }
    close(input);
    close(output);
    std::int32_t const reply = process;
    if (send(link, &reply, sizeof reply, MSG_NOSIGNAL) != sizeof reply) return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace gpu_shading::decoding
