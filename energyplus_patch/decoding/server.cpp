#include "decoding/server.h"

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

// A copy of this process, which has no other thread, as a child of its parent.
pid_t fork_sibling() {
  return static_cast<pid_t>(
      syscall(SYS_clone, CLONE_PARENT | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

}  // namespace

int serve(std::function<int(std::vector<std::string> const&)> const& decode) {
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
