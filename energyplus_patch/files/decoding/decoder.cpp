#include "files/decoding/decoder.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <optional>
#include <system_error>

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
  std::array<char, max_request_bytes> bytes{};
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
  constexpr int max_rounds = 1000;
  for (int i = 0; i < max_rounds; ++i) {
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

// Serves until the other end of the socket is closed, or nothing is asked for a while. `decode`
// gets the words, with the descriptors as standard input and output, and returns the exit status.
// Returns the program's own.
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

constexpr std::size_t word_count = 6;

// What libraries say on their own does not reach the user; the reason is in the answer.
void silence_errors() {
  int const nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing >= 0) dup2(nothing, STDERR_FILENO);
}

// Libraries know the file by the name by which it was opened.
std::string named(std::string text, std::filesystem::path const& name) {
  std::string_view const opened(input_path);
  auto const put = name.filename().string();
  for (auto at = text.find(opened); at != std::string::npos; at = text.find(opened, at)) {
    text.replace(at, opened.size(), put);
    at += put.size();
  }
  return text;
}

// The process may have been given less, by ulimit -v.
Limits within_given(Limits limits) {
  rlimit given{};
  if (getrlimit(RLIMIT_AS, &given) == 0) {
    limits.memory = std::min<std::uint64_t>(limits.memory, given.rlim_cur);
  }
  return limits;
}

std::string out_of_memory(Limits const& limits) {
  constexpr unsigned mebibyte = 20;
  return "it takes more than " + std::to_string(limits.memory >> mebibyte) + " MiB of memory";
}

// Where there is no memory for the stack of a thread.
bool is_lack_of_memory(std::system_error const& error) {
  return error.code() == std::errc::resource_unavailable_try_again ||
         error.code() == std::errc::not_enough_memory;
}

int decode_file(std::vector<std::string> const& words, bool reads_neighbours,
                std::function<void(Request const&, DecodedMessage&)> const& decode) {
  if (words.size() != word_count) return EXIT_FAILURE;
  end_with(std::atoi(words[0].c_str()));
  closefrom(STDERR_FILENO + 1);  // the program that started this one may have left files open
  silence_errors();
  auto const limits = within_given(
      {std::strtoull(words[1].c_str(), nullptr, 10), std::strtoull(words[2].c_str(), nullptr, 10)});
  Request const request{words[3], words[5], words[4] == "any"};
  DecodedMessage answer(STDOUT_FILENO);
  std::string why;
  try {
    auto const folder = std::filesystem::absolute(request.name).parent_path();
    auto readable = std::optional(Readable{reads_neighbours ? folder : std::filesystem::path()});
    if (request.any) readable.reset();
    confine(limits, STDIN_FILENO, readable);
    decode(request, answer);
    answer.flush();
    return EXIT_SUCCESS;
  } catch (std::bad_alloc const&) {
    why = out_of_memory(limits);
  } catch (std::system_error const& error) {
    why = is_lack_of_memory(error) ? out_of_memory(limits) : error.what();
  } catch (std::exception const& error) {
    why = error.what();
    // Libraries that catch it pass only its name on.
    if (why.find("bad_alloc") != std::string::npos) why = out_of_memory(limits);
  } catch (...) {
    why = "unknown error";
  }
  try {
    return answer.fail(named(why, request.name)) ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (std::exception const&) {
    return EXIT_FAILURE;
  }
}

}  // namespace

int run_decoder(bool reads_neighbours,
                std::function<void(Request const&, DecodedMessage&)> const& decode) {
  return serve([&](std::vector<std::string> const& words) {
    return decode_file(words, reads_neighbours, decode);
  });
}

}  // namespace gpu_shading::decoding
