#include "files/decoding_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>

#include "files/decoding/decoded_message.h"
#include "files/decoding/landlock.h"
#include "files/unconfined_decoding.h"
#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] void fail_to_decode(char const* what) {
  throw Error(fmt::format("{}: {}", what, std::strerror(errno)));
}

// Opens a file that must be a regular one, of no more than a size.
void open_input(FileDescriptor const& file, std::uint64_t max_bytes) {
  struct stat found {};
  if (!file.is_open()) fail_to_decode("cannot be opened");
  if (fstat(file.get(), &found) != 0) fail_to_decode("cannot be opened");
  if (!S_ISREG(found.st_mode)) throw Error("is not a file");
  if (static_cast<std::uint64_t>(found.st_size) > max_bytes) {
    constexpr unsigned mebibyte = 20;
    throw Error(fmt::format("is larger than {} MiB", max_bytes >> mebibyte));
  }
}

thread_local bool any_unconfined = false;

std::string in_one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), is_control, ' ');
  return text;
}

}  // namespace

bool take_unconfined_decoding() { return std::exchange(any_unconfined, false); }

DecodingProcess::DecodingProcess(char const* program, std::string const& operation,
                                 std::filesystem::path const& file, Assets assets,
                                 DecodingLimits const& limits)
    : limits_(limits), deadline_(limits.wait) {
  FileDescriptor const input(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  open_input(input, limits.file_size);
  std::array<int, 2> ends{-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_decode("no pipe for its decoding");
  answer_.emplace(ends[0]);
  FileDescriptor const output(ends[1]);
  if (assets == Assets::restricted && decoding::landlock_version() < 1) any_unconfined = true;
  process_ = start_decoding(
      program,
      {std::to_string(getpid()), std::to_string(limits.seconds), std::to_string(limits.memory),
       operation, assets == Assets::any ? "any" : "restricted",
       std::filesystem::absolute(file).string()},
      input.get(), output.get(), deadline_);
}

DecodingProcess::~DecodingProcess() {
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

double DecodingProcess::next_double() {
  double value = 0.0;
  read(&value, sizeof value);
  return value;
}

std::string DecodingProcess::next_text() {
  auto const length = next<std::uint32_t>(0, decoding::max_name_bytes);
  std::string text(length, '\0');
  read(text.data(), text.size());
  return in_one_line(std::move(text));
}

void DecodingProcess::finish() {
  char beyond = 0;
  begin();
  if (read_some(&beyond, 1) != 0) throw_invalid();
  if (int const status = wait(); status != 0) throw_reason(status);
}

void DecodingProcess::throw_invalid() {
  throw Error("the program that decodes it gave an invalid answer");
}

void DecodingProcess::begin() {
  if (begun_) return;
  begun_ = true;
  auto const mark = next<std::uint32_t>(0, std::numeric_limits<std::uint32_t>::max());
  if (mark != decoding::message_mark) throw_invalid();
  using decoding::Status;
  auto const status = next<std::uint32_t>(0, static_cast<std::uint32_t>(Status::failed));
  if (status == static_cast<std::uint32_t>(Status::failed)) throw Error(next_text());
}

void DecodingProcess::read(void* bytes, std::size_t count) {
  begin();
  auto* to = static_cast<char*>(bytes);
  while (count > 0) {
    auto const got = read_some(to, count);
    if (got == 0) throw_reason(wait());
    to += got;
    count -= got;
  }
}

std::size_t DecodingProcess::read_some(char* bytes, std::size_t count) {
  while (true) {
    pollfd watched{answer_->get(), POLLIN, 0};
    int const ready = poll(&watched, 1, deadline_.milliseconds_left());
    if (ready == 0) deadline_.fail();
    if (ready < 0) {
      if (errno == EINTR) continue;
      fail_to_decode("no answer of its decoding");
    }
    auto const got = ::read(answer_->get(), bytes, count);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) fail_to_decode("no answer of its decoding");
  }
}

// Returns the status of waitpid(). The process has closed its output, so that its end is near.
int DecodingProcess::wait() {
  int status = 0;
  while (true) {
    auto const ended = waitpid(process_, &status, WNOHANG);
    if (ended == process_) break;
    if (ended < 0 && errno != EINTR) {  // this process lets the system wait for its children
      status = 0;
      break;
    }
    if (deadline_.is_over()) deadline_.fail();
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  process_ = -1;
  return status;
}

void DecodingProcess::throw_reason(int status) const {
  if (WIFSIGNALED(status)) {
    int const signal = WTERMSIG(status);
    if (signal == SIGXCPU) {
      throw Error(fmt::format("it takes more than {} s of processor time", limits_.seconds));
    }
    throw Error(fmt::format("the program that decodes it crashed ({})", strsignal(signal)));
  }
  throw Error(fmt::format("the program that decodes it ended with status {}", WEXITSTATUS(status)));
}

}  // namespace gpu_shading::energyplus
