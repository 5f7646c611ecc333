#include "files/decoding/decoder.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>

#include "files/decoding/server.h"

namespace gpu_shading::decoding {
namespace {

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
