// A decoding program that does what a damaged or malicious file might make one do, for
// decoding_process_test.cpp.

#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/decoding/decoder.h"

namespace {

using namespace gpu_shading::decoding;

void write_raw(std::vector<std::uint32_t> const& words) {
  for (auto const word : words) {
    if (write(STDOUT_FILENO, &word, sizeof word) != sizeof word) _exit(EXIT_FAILURE);
  }
}

[[noreturn]] void stop() { _exit(EXIT_SUCCESS); }

void spin() {
  bool volatile always = true;
  while (always) {
  }
}

void fill_memory() {
  constexpr std::size_t block = std::size_t{16} << 20U;
  std::vector<std::vector<char>> blocks;
  while (true) blocks.emplace_back(block, 'x');
}

// Answers 1 if it could be done, else 0.
std::map<std::string, std::function<bool(Request const&)>> const tried{
    {"read input", [](Request const&) { return open(input_path, O_RDONLY) >= 0; }},
    {"read another file", [](Request const&) { return open("/etc/passwd", O_RDONLY) >= 0; }},
    {"write a file",
     [](Request const& request) {
       auto const path = request.name.string() + ".written";
       constexpr mode_t mode = 0600;
       return open(path.c_str(), O_WRONLY | O_CREAT, mode) >= 0;
     }},
    {"change the input", [](Request const&) { return open(input_path, O_RDWR) >= 0; }},
    {"remove a file", [](Request const& request) { return unlink(request.name.c_str()) == 0; }},
    {"open a socket", [](Request const&) { return socket(AF_INET, SOCK_STREAM, 0) >= 0; }},
    {"start a process",
     [](Request const&) {
       auto const child = fork();
       if (child == 0) _exit(EXIT_SUCCESS);
       return child > 0;
     }},
    {"run a program",
     [](Request const&) {
       execl("/bin/true", "/bin/true", nullptr);
       return false;
     }},
    {"signal its parent", [](Request const&) { return kill(getppid(), 0) == 0; }},
    // With all three, the kernel sends the signal to the parent at the next byte of the answer.
    {"choose who gets signals",
     [](Request const&) { return fcntl(STDOUT_FILENO, F_SETOWN, getppid()) == 0; }},
    {"choose a signal", [](Request const&) { return fcntl(STDOUT_FILENO, F_SETSIG, SIGURG) == 0; }},
    {"ask for signals", [](Request const&) { return fcntl(STDOUT_FILENO, F_SETFL, O_ASYNC) == 0; }},
    {"ask for a lease",
     [](Request const&) { return fcntl(STDIN_FILENO, F_SETLEASE, F_RDLCK) == 0; }},
};

// Gives an answer, good or bad.
std::map<std::string, std::function<void(DecodedMessage&)>> const done{
    {"crash", [](DecodedMessage&) { raise(SIGSEGV); }},
    {"abort", [](DecodedMessage&) { std::abort(); }},
    {"spin", [](DecodedMessage&) { spin(); }},
    {"sleep",
     [](DecodedMessage&) {
       while (true) sleep(1000);
     }},
    {"fill memory", [](DecodedMessage&) { fill_memory(); }},
    {"say nothing", [](DecodedMessage&) { stop(); }},
    {"wrong mark",
     [](DecodedMessage&) {
       write_raw({1, 0, 1});
       stop();
     }},
    {"wrong status",
     [](DecodedMessage&) {
       write_raw({message_mark, 2, 1});
       stop();
     }},
    {"endless reason",
     [](DecodedMessage&) {
       write_raw({message_mark, 1, ~0U});
       stop();
     }},
    {"reason of two lines", [](DecodedMessage&) { throw std::runtime_error("one\nline\x1b[2J"); }},
    {"too large", [](DecodedMessage& answer) { answer.put(std::uint32_t{1000}); }},
    {"end early",
     [](DecodedMessage& answer) {
       answer.put(std::uint32_t{7});
       answer.flush();
       stop();
     }},
    {"crash at the end",
     [](DecodedMessage& answer) {
       answer.put(std::uint32_t{7});
       answer.put(std::uint32_t{8});
       answer.flush();
       raise(SIGSEGV);
     }},
    {"say more",
     [](DecodedMessage& answer) {
       for (std::uint32_t i = 0; i < 3; ++i) answer.put(std::uint32_t{7});
     }},
    {"be good",
     [](DecodedMessage& answer) {
       answer.put(std::uint32_t{7});
       answer.put(std::uint32_t{8});
     }},
};

}  // namespace

int main() {
  _exit(run_decoder(false, [](Request const& request, DecodedMessage& answer) {
    if (auto const found = done.find(request.operation); found != done.end()) {
      found->second(answer);
    } else {
      answer.put(std::uint32_t{tried.at(request.operation)(request) ? 1U : 0U});
      answer.put(std::uint32_t{8});
    }
  }));
}
