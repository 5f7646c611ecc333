// Stands in for the decoding programs: answers with the bytes of its file.

#include <unistd.h>

#include <array>
#include <cstdlib>

#include "files/decoding/decoder.h"

namespace {

using namespace gpu_shading::decoding;

[[noreturn]] void echo() {
  std::array<char, 65536> bytes{};
  while (true) {
    auto const got = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (got <= 0) _exit(got == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
    for (ssize_t done = 0; done < got;) {
      auto const sent =
          write(STDOUT_FILENO, bytes.data() + done, static_cast<std::size_t>(got - done));
      if (sent < 0) _exit(EXIT_FAILURE);
      done += sent;
    }
  }
}

}  // namespace

int main() {
  _exit(run_decoder(false, [](Request const& /*request*/, DecodedMessage& /*answer*/) { echo(); }));
}
