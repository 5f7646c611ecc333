#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "files/decoding/decoded_message.h"
#include "files/decoding/sandbox.h"

// A decoding program is started once and then decodes each file in a process of its own, since
// loading its libraries takes longer than decoding most files. Its standard input is a socket of
// type SOCK_SEQPACKET; standard output and error must be open. A request is a packet of words, each
// with a zero byte after it, and two descriptors: the file and where its answer goes. The reply is
// the number of the new process (32 bits), or -1 if there is none. That process is a child of the
// one that asks.
namespace gpu_shading::decoding {

[[noreturn]] inline void fail(std::string const& why) {
  throw std::runtime_error(why.empty() ? "no reason is given" : why);
}

inline constexpr std::size_t max_request_bytes = 16384;

// The file that a decoding program reads is its standard input; libraries open it by this name.
inline constexpr char const* input_path = "/proc/self/fd/0";

// How a decoding program is called.
struct Request {
  // What to read, and how the file is called.
  std::string operation;
  std::filesystem::path name;
  // Whether any format of the library is read, and whatever other file the file names.
  bool any = false;
};

// The body of a decoding program's main(), which serves requests of the words PARENT SECONDS BYTES
// OPERATION any|restricted NAME. `decode` puts its answer, or throws std::exception with the
// reason. `reads_neighbours`: whether it reads files beside the file. Returns the exit status.
int run_decoder(bool reads_neighbours,
                std::function<void(Request const&, DecodedMessage&)> const& decode);

}  // namespace gpu_shading::decoding
